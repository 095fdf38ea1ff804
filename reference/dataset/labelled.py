"""The dataset in xarray's terms."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from reference.names import unknown

if TYPE_CHECKING:
    from reference.dataset.reader import Dataset

__all__ = ["to_xarray"]


def to_xarray(dataset: Dataset, group: str | None = None) -> Any:
    """One group as an ``xarray.Dataset``, or all as an ``xarray.DataTree``; tails are variables ``NAME_tail``.

    Raises:
        ImportError: xarray is not installed.
        KeyError: there is no such group.
    """
    try:
        import xarray
    except ImportError:
        raise ImportError("xarray is not installed; 'pip install horologium[xarray]' provides it.") from None
    if group is None:
        return xarray.DataTree.from_dict({name: to_xarray(dataset, name) for name in dataset.groups})
    name = group.strip("/")
    if name not in dataset.groups:
        raise KeyError(unknown("group", group, dataset.groups))
    members = [variable for path, variable in dataset.items() if path.rpartition("/")[0] == name]
    data: dict[str, Any] = {}
    for variable in members:
        short = variable.name.rpartition("/")[2]
        attributes = {key: value for key, value in variable.attrs.items() if key != "coordinates"}
        data[short] = (variable.dims, variable.value, attributes)  # xarray writes "coordinates" itself
        if not variable.is_input:
            data[f"{short}_tail"] = ((*variable.dims, "limb"), variable.tail, {"units": variable.units})
    inputs = {variable.name.rpartition("/")[2] for variable in members if variable.is_input}
    return xarray.Dataset(
        {short: entry for short, entry in data.items() if short not in inputs},
        coords={short: entry for short, entry in data.items() if short in inputs},
        attrs=dataset.groups[name],
    )
