"""``score --format html``: a page that stands alone, with each number split at its first wrong digit."""

from __future__ import annotations

import re
from html.parser import HTMLParser

import numpy as np
import pytest

from compare.__main__ import main
from compare.files.show import marked, parts_of
from reference import Pendulum

P = Pendulum(1.0)
T = np.arange(0, 40) / 8
Y = P.state(T)
VOID = {"meta", "br", "hr", "img", "link", "input"}


class Tree(HTMLParser):
    """The elements of a page in their order, as (name, attributes, text); tags are closed in order."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.found: list[tuple[str, dict, list[str]]] = []
        self._open: list[tuple[str, dict, list[str]]] = []
        self.feed(text)
        self.close()
        assert not self._open

    def handle_starttag(self, tag, attrs):
        one = tag, dict(attrs), []
        assert len(one[1]) == len(attrs)
        self.found.append(one)
        if tag not in VOID:
            self._open.append(one)

    def handle_endtag(self, tag):
        assert self._open.pop()[0] == tag

    def handle_data(self, data):
        for _, _, texts in self._open:
            texts.append(data)

    def texts(self, name: str, kind: str | None = None) -> list[str]:
        return ["".join(text) for tag, given, text in self.found if tag == name and kind in (None, given.get("class"))]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("html")


@pytest.fixture(scope="module")
def rows() -> list[list[str]]:
    table = [[repr(number) for number in (t, *y)] for t, y in zip(T.tolist(), Y.tolist(), strict=True)]
    table[3][1] = table[3][1][:6]
    table[5][2] = f"{Y[5, 1] + 1e-7:.17e}"
    table[7] = [table[7][0], "-0", "1.5D+00"]
    return table


def page(path, rows, capsys, *options: str) -> str:
    path.write_text("\n".join(["t,theta,omega", *map(",".join, rows)]))
    assert main(["score", str(path), "--theta0", "1", "--format", "html", "--rows", "99", *options]) == 0
    return capsys.readouterr().out


def test_the_parts_of_each_number_are_the_number_that_was_handed_in(folder, rows, capsys):
    tree = Tree(page(folder / "a.csv", rows, capsys))
    (table,) = (text for tag, _, text in tree.found if tag == "tbody")
    assert table
    cells = [text for tag, given, text in tree.found if tag == "td" and given.get("class") == "number"]
    codes = [re.sub(r" \(.*\)$", "", "".join(text)) for text in cells]
    assert codes == [number for row in rows for number in row[1:]]


def test_wrong_digits_are_marked_from_where_the_text_has_its_bracket(folder, rows, capsys):
    text = page(folder / "a.csv", rows, capsys)
    wrong = Tree(text).texts("mark")
    assert main(["score", str(folder / "a.csv"), "--theta0", "1", "--rows", "99"]) == 0
    table, _, _ = capsys.readouterr().out.partition("\n\n[ ]")
    brackets = re.findall(r"\[(\d)\]([\d.]*)", table)
    written = [digit + rest for digit, rest in brackets if (digit + rest) in wrong]
    assert written == wrong
    assert len(wrong) >= 3
    assert 'content: "["' in text  # not by colour alone


def test_the_number_beside_is_the_proven_one(folder, rows, capsys):
    tree = Tree(page(folder / "a.csv", rows, capsys))
    exact = tree.texts("td", "number exact")
    wanted = [P.certified("state", t, i).digits(21) for t in T.tolist() for i in (0, 1)]
    assert exact == wanted


def test_the_page_stands_alone_and_is_whole(folder, rows, capsys):
    text = page(folder / "a.csv", rows, capsys)
    tree = Tree(text)
    names = [tag for tag, _, _ in tree.found]
    assert text.startswith("<!DOCTYPE html>\n")
    assert names[:2] == ["html", "head"]
    assert not {"script", "link", "img", "iframe"} & set(names)
    assert "http" not in text
    assert "url(" not in text
    assert "prefers-color-scheme: dark" in text
    assert all(given.get("scope") in {"col", "row"} for tag, given, _ in tree.found if tag == "th")
    (caption,) = (given["id"] for tag, given, _ in tree.found if tag == "caption")
    (region,) = (given for _, given, _ in tree.found if given.get("role") == "region")
    assert region["aria-labelledby"] == caption
    widths = [text.count("</th>") + text.count("</td>") for text in text.splitlines() if text.startswith("<tr>")]
    assert len(widths) == 40
    assert len(set(widths)) == 1
    assert "40 rows, worst " in "".join(tree.texts("p"))


HOSTILE = '<img src=x onerror="alert(1)">&amp;'


def test_names_are_text_and_no_markup(folder, rows, capsys):
    path = folder / "x<script>alert('1')&lt; .csv"
    text = page(path, rows, capsys)
    assert "<script" not in text
    assert "&lt;script&gt;alert(&#x27;1&#x27;)&amp;lt;" in text
    header = f'"{HOSTILE.replace(chr(34), chr(34) * 2)}",theta,omega\n'
    path.write_text(header + "\n".join(map(",".join, rows)))
    quoted = HOSTILE.replace('"', '""')
    words = ["--columns", f'"{quoted}",theta,omega', "--format", "html"]
    assert main(["score", str(path), "--theta0", "1", *words]) == 0
    assert "<img" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "place"),
    [("0.9989", 1), ("-0.00123", 2), ("12.5e-3", 3), ("1.5D+00", 2), ("0.5", 4), ("7", 2), ("0.0", 1), ("1/3", 1)],
)
def test_parts_join_to_the_number_and_begin_with_the_digit_in_brackets(text, place):
    right, wrong, rest = parts_of(text, place)
    assert right + wrong + rest == text
    assert not wrong or marked(text, place) == f"{right}[{wrong[0]}]{wrong[1:]}{rest}"
    assert parts_of(text, None) == (text, "", "")
