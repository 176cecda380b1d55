"""Waits for work, shows its progress, and reacts to Ctrl-C."""

import html
import shutil
import sys
from typing import Any, Callable, Optional

from . import _neumann

_steps = " ▏▎▍▌▋▊▉█"


def _bar(fraction: float, width: int = 10) -> str:
    whole, part = divmod(round(min(max(fraction, 0.0), 1.0) * width * 8), 8)
    return ("█" * whole + (_steps[part] if part else "")).ljust(width)


class _Nothing:
    def show(self, text: str, fraction: Optional[float]) -> None:
        pass

    def clear(self) -> None:
        pass


class _Terminal(_Nothing):
    """Shows progress in one line of stderr, which is overwritten; does nothing if stderr is not a terminal."""

    def __init__(self) -> None:
        self._shown = False

    def show(self, text: str, fraction: Optional[float]) -> None:
        if not sys.stderr.isatty():
            return
        line = text if fraction is None else f"{_bar(fraction)} {text}"
        sys.stderr.write("\r\033[K" + line[: shutil.get_terminal_size().columns - 1])
        sys.stderr.flush()
        self._shown = True

    def clear(self) -> None:
        if self._shown:
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()
            self._shown = False


class _Notebook(_Nothing):
    """Shows progress as a bar below the cell, which disappears at the end."""

    def __init__(self) -> None:
        self._handle: Any = None

    def show(self, text: str, fraction: Optional[float]) -> None:
        from IPython.display import HTML, display

        bar = "" if fraction is None else f'<progress value="{min(fraction, 1.0):.3f}" max="1"></progress> '
        shown = HTML(f'<div style="font-family: monospace">{bar}{html.escape(text)}</div>')
        if self._handle is None:
            self._handle = display(shown, display_id=True)
        else:
            self._handle.update(shown)

    def clear(self) -> None:
        if self._handle is not None:
            from IPython.display import HTML

            self._handle.update(HTML(""))
            self._handle = None


def in_notebook() -> bool:
    """Whether the program runs in a notebook, which shows what is printed."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return type(shell).__name__ == "ZMQInteractiveShell"


def run(job: "_neumann.Job", quiet: bool = False, wrap: Callable[[Any], Any] = lambda made: made) -> Any:
    """Returns the result of a job, wrapped. Ctrl-C ends the job early; its result until then, if there is any, is ``result`` of the
    KeyboardInterrupt."""
    line = _Nothing() if quiet else _Notebook() if in_notebook() else _Terminal()
    try:
        while not job.wait(0.1):
            text, fraction = job.progress()
            if text:
                line.show(text, fraction)
    except BaseException as stop:
        job.stop()
        line.show("stopping", None)
        while not job.wait(0.1):
            pass
        line.clear()
        if isinstance(stop, KeyboardInterrupt):
            try:
                stop.result = wrap(job.result())  # type: ignore[attr-defined]
            except Exception:
                pass  # there is no result yet
        raise
    finally:
        line.clear()
    return wrap(job.result())
