"""The page of a study: whole, self-contained, readable by machines, and true to the numbers."""

from __future__ import annotations

import math
import re
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest

from graphfx.errors import UsageError
from graphfx.study.candidates import FAMILIES
from graphfx.study.page import page
from graphfx.study.picture import need_matplotlib, picture
from graphfx.study.plot import HEIGHT, LEFT, RIGHT, TOP, WIDTH, Line, Plot, Point, power_of_ten, svg
from graphfx.study.recommend import advice
from graphfx.study.study import Maker, Study
from graphfx.study.style import COLOURS, style

from .problems import two_vortices

OPEN = ("meta", "input")


class Strict(HTMLParser):
    """Finds elements that are not closed, and ids that are there twice."""

    def __init__(self):
        super().__init__()
        self.open, self.ids, self.links = [], [], []

    def handle_starttag(self, tag, attrs):
        self.ids += [value for name, value in attrs if name == "id"]
        self.links += [value for name, value in attrs if name in ("src", "href")]
        if tag not in OPEN:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        """Open and close nothing."""

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, f"</{tag}>"


@pytest.fixture(scope="module")
def study() -> Study:
    return Maker(two_vortices(), most=10, frames=[12, 24], precisions=(64,), seconds=20.0, repeats=1).make()


@pytest.fixture(scope="module")
def text(study) -> str:
    return page(study)


def test_the_page_is_well_formed(text):
    """Every element is closed where it should be, and no id is given twice."""
    reader = Strict()
    reader.feed(text)
    assert reader.open == [] and len(reader.ids) == len(set(reader.ids))


def test_the_page_needs_nothing_else(text):
    """No script, no font and no picture is loaded; the one link goes to the data beside it."""
    reader = Strict()
    reader.feed(text)
    assert reader.links == ["study.json"]
    assert "http" not in text and "<script" not in text and "url(" not in text and "@import" not in text


def test_plots_are_told_to_those_who_do_not_see_them(text):
    """Each plot is a picture with a title and a description, and all numbers stand in a table."""
    plots = re.findall(r'<svg class="plot".*?</svg>', text, re.DOTALL)
    assert len(plots) == 9
    for plot in plots:
        root = ElementTree.fromstring(plot)
        title, description = root.attrib["aria-labelledby"].split()
        assert {each.attrib["id"] for each in root if "id" in each.attrib} == {title, description}
    assert text.count("<tr") > len(re.findall("64 bits</td>", text)) > 20


def test_the_page_says_what_is_recommended(study, text):
    """The setting, the lines to put into the graph, and a ring in every plot of errors."""
    best = advice(study).result.candidate
    assert f"<h2>{best.name}</h2>" in text and text.count('class="ring"') == 8
    assert "&quot;method&quot;" in text


def test_what_did_not_run_is_on_the_page(text):
    """A refusal stands there with its message."""
    assert "What did not run" in text and "there is no exact solution for vortex, vortex together" in text


def test_names_are_escaped(study):
    """A graph's name and its words are text, whatever they hold."""
    study.flat.name, study.flat.doc = "<b>&", "<script>"
    assert "<b>&" not in page(study) and "<script" not in page(study)


def test_a_study_without_truth_has_a_page():
    """What was stopped before its references were made says that nothing can be told."""
    assert "It cannot be told" in page(Study(two_vortices(), [24], stopped=True))


def plot(ys, **keys):
    points = [Point(10.0**k, y, "") for k, y in enumerate(ys)]
    return Plot("a", "t", "d", "x", [Line("f1", "circle", points)], 1e-3, **keys)


def test_axes_are_logarithmic():
    """Equal ratios are equal ways, upwards for greater errors and to the right for more work."""
    drawn = plot([1.0, 1e-2, 1e-4])
    assert drawn.x(100) - drawn.x(10) == pytest.approx(drawn.x(10) - drawn.x(1))
    assert drawn.y(1e-4) - drawn.y(1e-2) == pytest.approx(drawn.y(1e-2) - drawn.y(1.0)) and drawn.y(1.0) < drawn.y(1e-2)


def test_everything_is_inside():
    """Whatever is drawn stands within the frame, infinite errors in a strip above the axes, nothing at NaN."""
    for ys in ([1.0, math.inf, 0.0], [0.0, 0.0], [1e-300, 1e300], [math.inf]):
        drawn = plot(ys, floor=1e-9)
        for line in drawn.lines:
            for point in line.points:
                assert LEFT <= drawn.x(point.x) <= WIDTH - RIGHT and 0 < drawn.y(point.y) < HEIGHT
        assert "nan" not in svg(drawn) and "inf" not in svg(drawn)
    assert plot([math.inf]).y(math.inf) < TOP


def test_what_is_not_measured_is_hollow_and_at_the_floor():
    """A point below the difference of the references is drawn at it, and hollow."""
    drawn = plot([1e-2, 1e-9], floor=1e-6)
    assert drawn.y(1e-9) == drawn.y(1e-6) and svg(drawn).count("mark hollow") == 1


def test_powers_of_ten_in_words():
    """1e-3 m is a millimetre; what has no word is a power."""
    assert [power_of_ten(-3, {-3: "1 mm"}, " m"), power_of_ten(-12, {}, " m")] == ["1 mm", "10⁻¹² m"]


def test_every_family_has_its_colour():
    """There are as many colours as families, none twice, in light and dark; the style sheet closes all braces."""
    assert len(COLOURS) == len(FAMILIES) and len({*sum(COLOURS, ())}) == 2 * len(COLOURS)
    sheet = style(("p95",), len(FAMILIES))
    assert sheet.count("{") == sheet.count("}")


def luminance(colour):
    parts = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


@pytest.mark.parametrize("mode, card", [(0, "#ffffff"), (1, "#1b1d21")])
def test_colours_can_be_seen(mode, card):
    """Lines stand out from the card by a contrast of 3 to 1 at least (WCAG 2.2, 1.4.11)."""
    for colours in COLOURS:
        high, low = sorted((luminance(colours[mode]), luminance(card)), reverse=True)
        assert (high + 0.05) / (low + 0.05) >= 3


def test_a_picture_is_drawn_where_matplotlib_is(study):
    """The plots are a PNG of some size."""
    pytest.importorskip("matplotlib")
    drawn = picture(study)
    assert drawn.startswith(b"\x89PNG") and len(drawn) > 20_000


def test_without_matplotlib_the_extra_is_named(monkeypatch):
    """Before any work, what is missing is told with what brings it."""
    def missing(name):
        raise ModuleNotFoundError(name)

    monkeypatch.setattr("graphfx.study.picture.import_module", missing)
    with pytest.raises(UsageError, match=r'install it by: pip install "graphfx\[study\]"'):
        need_matplotlib()
