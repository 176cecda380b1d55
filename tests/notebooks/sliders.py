"""Figures that have sliders in a notebook where ipywidgets is there, and are drawn once where it is not: sliders.py NOTEBOOKS"""

import sys

from ipykernel.inprocess import InProcessKernelManager

try:
    import ipywidgets
except ImportError:
    ipywidgets = None

manager = InProcessKernelManager()
manager.start_kernel()
client = manager.client()
client.start_channels()
names = manager.kernel.shell.user_ns


def run(code):
    client.execute(code)
    reply = client.get_shell_msg(timeout=60)
    assert reply["content"]["status"] == "ok", reply["content"]


run(f"%matplotlib inline\nimport sys; sys.path.insert(0, {sys.argv[1]!r}); sys.argv = ['lesson']\nimport lesson")
run("drawn = []\nlesson.explore(lambda **values: drawn.append(values), bounce=(0, 5, 3), stops=(-1.0, 1.0, 0.5))")
assert names["drawn"] == [{"bounce": 3, "stops": 0.5}], names["drawn"]
if ipywidgets is None:
    print("Without ipywidgets: drawn once.")
    assert names["lesson"].sliders is None
else:
    print("ipywidgets", ipywidgets.__version__)
    made = getattr(ipywidgets.widgets.widget, "_instances", None) or ipywidgets.Widget.widgets  # of version 8, and of those before
    sliders = {w.description: w for w in made.values() if isinstance(w, (ipywidgets.IntSlider, ipywidgets.FloatSlider))}
    assert list(sliders) == ["bounce", "stops"]
    assert (sliders["bounce"].min, sliders["bounce"].max, sliders["stops"].step) == (0, 5, 0.04)
    sliders["bounce"].value = 5
    assert names["drawn"][-1] == {"bounce": 5, "stops": 0.5}, names["drawn"]
    run("lesson.sliders = None\nlesson.explore(lambda **values: drawn.append(values), bounce=(0, 5, 2))")
    assert names["drawn"][-1] == {"bounce": 2}
