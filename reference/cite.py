"""How to cite the dataset."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from reference.store import Dataset

__all__ = ["FORMATS", "cite"]

FORMATS = ("bibtex", "text")


def cite(dataset: Dataset, form: str = "bibtex") -> str:
    """The citation of a dataset as BibTeX or as a sentence, with version and fingerprint; dated where the file is."""
    title, version = dataset.attrs["title"], dataset.attrs["version"]
    creators, mark = dataset.attrs["creators"], f"sha256:{dataset.fingerprint}"
    year = str(dataset.provenance.get("date", ""))[:4]
    if form == "text":
        dated = f" ({year})" if year else ""
        return f"{creators}{dated}. {title}. Version {version}, {dataset.attrs['profile']} profile. Fingerprint {mark}."
    fields = {
        "author": f"{{{creators}}}",
        "title": f"{{{title}}}",
        **({"year": year} if year else {}),
        "version": version,
        "note": f"Dataset, {dataset.attrs['profile']} profile, version {version}, fingerprint {mark}",
        "copyright": dataset.attrs["license"],
    }
    body = "".join(f"  {name:<9} = {{{text}}},\n" for name, text in fields.items())
    return f"@misc{{horologium-{version},\n{body}}}"
