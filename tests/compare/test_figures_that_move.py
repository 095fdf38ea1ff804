"""The thesis' animations: bodies at their proven places at equal steps of time, as a GIF and as a page."""

from __future__ import annotations

import io
import json
import re

import numpy as np
import pytest
from PIL import Image

from compare.sources.figures.motion import figure8, figure13
from compare.sources.figures.moving_image import FRAMES_PER_SECOND, HELD, PACE, SLOWER, animated
from compare.sources.figures.page import STEPS_PER_SECOND
from compare.sources.figures.show import files
from reference import Descent, Tautochrone

NAMES = ("thesis-figure-8", "thesis-figure-13")


@pytest.fixture(scope="module")
def motions():
    return dict(zip(NAMES, (figure8(), figure13()), strict=True))


@pytest.fixture(scope="module")
def written():
    return files(NAMES)


def played(page):
    """What a page plays."""
    return json.loads(re.search(r'<script type="application/json"[^>]*>(.*?)</script>', page, re.DOTALL)[1])


def frames(content):
    """The frames of a GIF as pixels, and how long each is shown in ms."""
    with Image.open(io.BytesIO(content)) as image:
        assert image.info["loop"] == 0
        found = []
        for i in range(image.n_frames):
            image.seek(i)
            found.append((np.asarray(image.convert("RGB")).astype(int), image.info["duration"]))
    return [pixels for pixels, _ in found], [duration for _, duration in found]


def test_the_bodies_of_the_race_arrive_one_after_the_other_and_the_line_last(motions):
    line, quartic, cycloid = motions["thesis-figure-8"].bodies
    assert cycloid.arrival < quartic.arrival < line.arrival
    assert cycloid.arrival == float(Descent("cycloid", "9.81").descent_time())


def test_the_bodies_of_the_tautochrone_arrive_together(motions):
    bodies = motions["thesis-figure-13"].bodies
    assert len(bodies) == 4
    assert len({body.arrival for body in bodies}) == 1
    for body in bodies:
        before = body.places(np.array([0.8 * body.arrival, (1 - 1e-9) * body.arrival]))
        assert before[0, 1] > 0.05
        assert before[1, 1] < 1e-12


@pytest.mark.parametrize("name", NAMES)
def test_a_motion_lasts_from_the_release_until_the_last_has_arrived_and_no_step_longer(motions, name):
    motion = motions[name]
    last = max(body.arrival for body in motion.bodies)
    times = motion.times(FRAMES_PER_SECOND)
    assert times[0] == 0
    assert times[-2] < last <= times[-1]
    assert np.all(times == np.arange(len(times)) / FRAMES_PER_SECOND)


@pytest.mark.parametrize("name", NAMES)
def test_a_body_goes_down_its_way_and_stays_at_its_end(motions, name):
    for body in motions[name].bodies:
        times = motions[name].times(STEPS_PER_SECOND)
        places = body.places(times)
        assert np.all(np.diff(places[times < body.arrival, 1]) < 0)
        assert np.all(places[times >= body.arrival] == 0)
        assert np.all(body.places(np.array([body.arrival, 9.0])) == 0)


def test_the_panels_of_the_race_end_when_the_cycloid_alone_has_arrived(motions):
    motion = motions["thesis-figure-8"]
    line, quartic, cycloid = (body.places(motion.panels) for body in motion.bodies)
    assert cycloid[-1, 0] == 0
    assert line[-1, 0] > quartic[-1, 0] > 0.05
    assert line[0, 0] == quartic[0, 0] == cycloid[0, 0] == pytest.approx(np.pi)


@pytest.mark.parametrize("name", NAMES)
def test_the_gif_is_slower_than_the_motion_by_what_it_says_and_holds_its_end(motions, written, name):
    pictures, durations = frames(written[f"{name}.gif"])
    assert len(pictures) == len(motions[name].times(FRAMES_PER_SECOND * SLOWER))
    assert durations == [1000 // FRAMES_PER_SECOND] * (len(pictures) - 1) + [HELD]
    last = max(body.arrival for body in motions[name].bodies)
    assert sum(durations[:-1]) / 1000 == pytest.approx(SLOWER * last, abs=0.05)
    assert PACE == "¼ of real time"
    assert len(written[f"{name}.gif"]) < 1_500_000


def test_a_body_of_the_gif_is_where_it_is_proven_to_be_in_every_frame(motions, written):
    motion = motions["thesis-figure-13"]
    pictures, _ = frames(written["thesis-figure-13.gif"])
    top = motion.bodies[-1]  # drawn over the others
    proven = top.places(motion.times(FRAMES_PER_SECOND * SLOWER))
    seen = np.array([centre(picture, (0xCC, 0x79, 0xA7)) for picture in pictures])
    for axis in (0, 1):
        expected = np.polyval(np.polyfit(proven[:, axis], seen[:, axis], 1), proven[:, axis])
        assert np.max(np.abs(seen[:, axis] - expected)) < 0.75  # a marker is drawn at a whole pixel


def centre(picture, colour):
    """The middle (x, y) of the pixels of a colour, but for the mark in the corner of names, which never moves."""
    own = np.all(picture == colour, axis=-1)
    own[: picture.shape[0] // 2, : picture.shape[1] // 4] = False
    y, x = np.nonzero(own)
    return x.mean(), y.mean()


@pytest.mark.parametrize("name", NAMES)
def test_white_is_white_and_what_stands_still_does_not_flicker(written, name):
    pictures, _ = frames(written[f"{name}.gif"])
    for picture in pictures:
        assert tuple(picture[0, -1]) == (255, 255, 255)
        assert np.array_equal(picture[-120:, :60], pictures[0][-120:, :60])


def test_an_animation_of_more_colours_than_its_format_has_takes_the_nearest():
    red, green = np.meshgrid(np.arange(0, 256, 2), np.arange(0, 256, 32), indexing="ij")
    frame = np.stack([red, green, np.zeros_like(red)], axis=-1).astype(np.uint8)
    frame[:, 0] = 255
    (found,), _ = frames(animated([frame], [40]))
    assert np.all(found[:, 0] == 255)
    assert len(np.unique(found.reshape(-1, 3), axis=0)) <= 256
    assert np.array_equal(frames(animated([frame[:16]], [40]))[0][0], frame[:16])


def test_the_page_of_the_race_plays_the_proven_places(motions, written):
    data = played(written["thesis-figure-8.html"].decode())
    assert data["stepsPerSecond"] == STEPS_PER_SECOND
    steps = np.arange(len(data["bodies"][0]["places"]))
    for body, name in zip(data["bodies"], ("line", "quartic", "cycloid"), strict=True):
        race = Descent(name, "9.81")
        moving = steps[steps / STEPS_PER_SECOND < body["arrival"]]
        assert body["name"] == name
        assert body["arrival"] == float(race.descent_time())
        assert np.array_equal(np.array(body["places"])[moving], race.along("motion", moving / STEPS_PER_SECOND)[:, :2])
    assert len(steps) == len(motions["thesis-figure-8"].times(STEPS_PER_SECOND))


def test_the_page_of_the_tautochrone_plays_the_proven_places(written):
    data = played(written["thesis-figure-13.html"].decode())
    for body, start in zip(data["bodies"], ("3.13", "2.5", "2.0", "1.5"), strict=True):
        assert start in body["name"]
        exact = Tautochrone(start, 1, "9.81").along("position", np.arange(101) / 100)
        assert np.array_equal(np.array(body["places"])[:101], exact)
        assert body["places"][-1] == [0, 0]


@pytest.mark.parametrize("name", NAMES)
def test_the_page_needs_nothing_but_itself(written, name):
    page = written[f"{name}.html"].decode()
    assert not re.findall(r'(?:src|href)="[^#"]', page)
    assert not re.findall(r"@import|url\((?!#)|fetch\(|XMLHttpRequest", page)
    assert not re.search(r"\b20\d\d-\d\d", page)
    assert len(page) < 200_000


@pytest.mark.parametrize("name", NAMES)
def test_everything_that_the_page_moves_or_fills_is_there_once(written, name):
    page = written[f"{name}.html"].decode()
    bodies = range(len(played(page)["bodies"]))
    wanted = [f"{part}-{i}" for part in ("body", "height", "arrival") for i in bodies]
    for one in (*wanted, "play", "step", "clock", "speed", "motion", "title"):
        assert len(re.findall(rf'id="{one}"', page)) == 1, one


def first_mark(page, group):
    """Where the marker of a group of the picture is drawn."""
    found = re.search(rf'id="{group}".*?<use [^>]*x="([\d.]+)" y="([\d.]+)"', page, re.DOTALL)
    return [float(value) for value in found.groups()]


@pytest.mark.parametrize("name", NAMES)
def test_the_page_moves_bodies_by_the_scale_of_its_picture(written, name):
    page = written[f"{name}.html"].decode()
    data = played(page)
    drawn = np.array([first_mark(page, f"body-{i}") for i in range(len(data["bodies"]))])
    starts = np.array([body["places"][0] for body in data["bodies"]])
    across, down = data["unitsPerMetre"]
    assert np.diff(drawn, axis=0) == pytest.approx(np.diff(starts, axis=0) * [across, down], abs=1e-4)
    assert across == pytest.approx(-down, rel=1e-6)


def test_the_page_can_be_used_without_seeing_it_and_stands_still_where_motion_is_not_wanted(written):
    page = written["thesis-figure-8.html"].decode()
    assert '<html lang="en">' in page
    assert 'role="img" aria-labelledby="title"' in page
    assert 'aria-label="time since the release"' in page
    assert 'matchMedia("(prefers-reduced-motion: reduce)")' in page
    assert "if (!calm) play();" in page
