"""How to cite the dataset."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from reference.dataset.reader import Dataset

__all__ = ["cite"]


def cite(dataset: Dataset, form: str = "bibtex") -> str:
    """The citation of a dataset as BibTeX or as a sentence, with version and fingerprint.

    The year is the file's, where it is dated, else that in which its version of the program was released.
    """
    from reference.dataset.schema import RELEASED

    title, version = dataset.attrs["title"], dataset.attrs["version"]
    creators, mark = dataset.attrs["creators"], f"sha256:{dataset.fingerprint}"
    year = str(dataset.provenance.get("date", RELEASED[version]))[:4]
    profile = f"{dataset.attrs['profile']} profile" + f" of {' and '.join(dataset.families)}" * bool(dataset.families)
    if form == "text":
        return f"{creators} ({year}). {title}. Version {version}, {profile}. Fingerprint {mark}."
    fields = {
        "author": f"{{{creators}}}",
        "title": f"{{{title}}}",
        "year": year,
        "version": version,
        "note": f"Dataset, {profile}, version {version}, fingerprint {mark}",
        "copyright": dataset.attrs["license"],
    }
    body = "".join(f"  {name:<9} = {{{text}}},\n" for name, text in fields.items())
    return f"@misc{{horologium-{version},\n{body}}}"
