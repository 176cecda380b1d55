"""A comparison of methods: error against time, bounce by bounce."""

from typing import Any, List, Union

import numpy as np
from numpy.typing import NDArray

from . import _report
from ._display import as_table
from ._report import Report


class Study:
    """The result of ``neumann study``.

    data: study.json as a Report: reference, budgets, and for each picture the methods, ranked, with all their points.
    table: study.csv as a structured array, a row for each method, budget, repeat and bounce: ``"mse"``, ``"rel_mse"``, ``"rays"`` …
    warnings: those of the command. complete: whether the study was not ended by Ctrl-C."""

    def __init__(self, json: str, csv: str, warnings: List[str], complete: bool) -> None:
        self.data: Report = _report.from_json(json)
        self.table: NDArray[Any] = _report.table(csv)
        self.warnings = warnings
        self.complete = complete

    @property
    def methods(self) -> List[str]:
        """The methods as they were given."""
        return [m.name for m in self.data.methods]

    def _of(self, method: str, bounce: Union[int, str]) -> Report:
        for picture in self.data.pictures:
            if picture.bounce == str(bounce):
                for found in picture.methods:
                    if found.method == method:
                        return found
        raise KeyError(f"no method {method!r} with a bounce {bounce!r} in this study")

    def curve(self, method: str, bounce: Union[int, str] = "sum") -> NDArray[Any]:
        """Returns error against time of a method in a bounce, or in the "sum", as a structured array with a row for each budget.

        samples a pixel, seconds and rays of a run, rmse and its standard error rmse_stderr, rel_mse, variance, bias_squared,
        efficiency 1/(variance · seconds), efficiency_with_bias 1/(mse · seconds). Radiance is in W·m⁻²·sr⁻¹."""
        rows = []
        for p in self._of(method, bounce).points:
            row = [p.samples, p.seconds.value, p.rays, p.rmse.value, p.rmse.standard_error, p.rel_mse.value, p.variance.value]
            row += [p.bias_squared.value, p.efficiency, p.efficiency_with_bias]
            rows.append([np.nan if x is None else x for x in row])
        names = ["samples", "seconds", "rays", "rmse", "rmse_stderr", "rel_mse", "variance", "bias_squared", "efficiency"]
        return _report.rows(np.array(rows, dtype=float), [*names, "efficiency_with_bias"])

    def slope(self, method: str, bounce: Union[int, str] = "sum") -> Any:
        """Returns d log RMSE / d log seconds: a Report of value and interval95, half of the interval; None with too few budgets."""
        return self._of(method, bounce).slope

    def __repr__(self) -> str:
        cut = "" if self.complete else ", cut off"
        return f"<Study of {self.data.scene.file}: {', '.join(self.methods)}; bounces 0 to {self.data.bounces}, {self.data.repeats} repeats{cut}>"

    def _repr_html_(self) -> str:
        names = ["bounce", "rank", "method", "RMSE", "relMSE", "seconds", "1/(V T)", "slope"]
        rows: List[List[Any]] = []
        for picture in self.data.pictures:
            for m in picture.methods:
                p = m.points[-1]
                slope = "" if m.slope is None else f"{m.slope.value:.2f} ± {m.slope.interval95 or np.nan:.2f}"
                efficiency = "infinite V" if m.infinite_variance else p.efficiency
                cells = [p.rmse.value, p.rel_mse.value, p.seconds.value, efficiency]
                rows.append([picture.bounce, m.rank, m.method, *("" if c is None else c for c in cells), slope])
        return as_table(names, rows, f"{self.data.scene.file}, at the largest budget, {self.data.repeats} repeats")
