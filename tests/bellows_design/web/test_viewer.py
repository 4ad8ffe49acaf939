"""The viewer in a real browser: what it shows, by mouse and keys, narrow and dark."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from browser import NARROW, hard_to_read, opened, wider_than_the_window
from shapes_to_show import bent_grid, block, hollow, sheared
from unpacking import unpacked

from bellows_design.web.element import viewer_element, viewer_page, viewer_script
from bellows_design.web.packing import packed
from bellows_design.web.scene import Field, Lines, SceneError, Shown, Surface
from bellows_design.web.style import page_style

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.browser

FIRST = "Bellows.of(document.querySelector('.bellows-view'))"


@contextmanager
def shown(
    browser: Browser, folder: Path, surfaces: list[Shown], text: str = "", **options: Any
) -> Iterator[Page]:
    """A page with one viewer; when the block ends, nothing may have gone wrong on it."""
    window = {
        name: options.pop(name)
        for name in ("width", "theme", "calm", "has_touch")
        if name in options
    }
    file = folder / "page.html"
    page_text = viewer_page(surfaces, "A <block>", **options)
    file.write_text(page_text.replace("</body>", f"{text}</body>"), "utf-8")
    with opened(browser, file, **window) as (page, seen):
        page.wait_for_selector(".bellows-view[data-ready]")
        yield page
        assert seen.all == []


def state(page: Page) -> dict[str, Any]:
    """What the first viewer says it shows."""
    found: dict[str, Any] = page.evaluate(f"async () => (await {FIRST}).state()")
    return found


def told(page: Page, call: str) -> Any:
    """Call a method of the first viewer."""
    return page.evaluate(f"async () => {{ await (await {FIRST}).{call} }}")


def show(page: Page, surface: Surface) -> None:
    """Show another scene from where the camera is."""
    page.evaluate(
        f"""async (text) => {{
          const viewer = await {FIRST};
          viewer.show(await Bellows.unpack(Bellows.bytesOfBase64(text)), {{ keepView: true }});
        }}""",
        base64.b64encode(packed([surface])).decode(),
    )


def pixels(page: Page) -> np.ndarray:
    """What WebGL drew, behind all that lies over it. *Shape:* `(height, width, 4)`."""
    from io import BytesIO

    from PIL import Image

    address = page.evaluate(
        f"async () => {{ const v = await {FIRST}; v.render(); return v.canvas.toDataURL(); }}"
    )
    picture = base64.b64decode(address.split(",")[1])
    return np.asarray(Image.open(BytesIO(picture)).convert("RGBA"), dtype=int)


def drawn(picture: np.ndarray) -> np.ndarray:
    """(height, width): where something is drawn."""
    return np.asarray(picture[:, :, 3] > 127)


def test_the_browser_unpacks_what_python_packed(browser: Browser, tmp_path: Path) -> None:
    surface = bent_grid(400, 3)
    data = packed([surface, sheared()])
    expected = unpacked(data)
    with shown(browser, tmp_path, [sheared()]) as page:
        found = page.evaluate(
            """async (text) => {
              const { surfaces } = await Bellows.unpack(Bellows.bytesOfBase64(text));
              return surfaces.map((surface) => ({
                cells: [...surface.cells],
                levels: [...surface.levels],
                fields: surface.fields.map((field) => [...field.levels]),
              }));
            }""",
            base64.b64encode(data).decode(),
        )
    for number, given in enumerate((surface, sheared())):
        np.testing.assert_array_equal(found[number]["cells"], given.triangles.ravel())
        about = expected.header["surfaces"][number]
        low, high = np.array(about["low"]), np.array(about["high"])
        span = np.maximum(high - low, 1e-300)
        levels = np.rint((expected.positions(number) - low) / span * 65535)
        np.testing.assert_array_equal(found[number]["levels"], levels.ravel())
    values = expected.values(0, 0)
    np.testing.assert_allclose(
        np.array(found[0]["fields"][0]) / 65534 * np.ptp(values) + values.min(), values.ravel()
    )


def test_the_slider_moves_the_shape_and_the_label(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path, [sheared()]) as page:
        before = state(page)
        slider = page.get_by_label("Frame", exact=True)
        slider.fill("4")
        after = state(page)
        assert page.locator("output").first.text_content() == "0.08 MPa"
        assert (before["frame"], after["frame"]) == (0, 4)
        rest, moved = (np.array(each["surfaces"][0]["sample"]) for each in (before, after))
        np.testing.assert_allclose(moved[:, 0] - rest[:, 0], 20 * rest[:, 2] / 10, atol=1e-2)
        slider.fill("1.5")
        between = np.array(state(page)["surfaces"][0]["sample"])
        np.testing.assert_allclose(between[:, 0] - rest[:, 0], 7.5 * rest[:, 2] / 10, atol=1e-2)
        slider.press("ArrowRight")
        assert state(page)["frame"] == 3
        told(page, "setFrame(99)")
        assert state(page)["frame"] == 4


def test_what_moves_moves_on_the_screen(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path, [sheared()], view="front") as page:
        before = drawn(pixels(page))
        told(page, "setFrame(4)")
        after = drawn(pixels(page))
    scale = before.any(axis=0).sum() / 40
    moved = np.flatnonzero(after.any(axis=0)).max() - np.flatnonzero(before.any(axis=0)).max()
    assert moved == pytest.approx(20 * scale, abs=3)


def test_keys_turn_zoom_and_step(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path, [sheared()]) as page:
        page.keyboard.press("Tab")
        assert page.evaluate("document.activeElement.className") == "bellows-view"
        ring = (
            "getComputedStyle(document.activeElement.shadowRoot.activeElement, '::after').boxShadow"
        )
        assert "3px" in page.evaluate(ring)
        cameras = [state(page)["camera"]]
        for key in ("ArrowRight", "ArrowUp", "+", "Shift+ArrowLeft"):
            page.keyboard.press(key)
            cameras.append(state(page)["camera"])
        start, right, up, near, aside = cameras
        assert right["position"][2] == pytest.approx(start["position"][2])
        assert right["target"] == pytest.approx(start["target"])
        assert right["position"] != pytest.approx(start["position"])
        assert up["position"][2] > right["position"][2]
        assert near["zoom"] == pytest.approx(1.2 * up["zoom"])
        assert aside["target"] != near["target"]
        page.keyboard.press("]")
        assert state(page)["frame"] == 1
        page.keyboard.press("[")
        assert state(page)["frame"] == 0
        page.keyboard.press("r")
        whole = state(page)["camera"]
        assert whole["position"] == pytest.approx(start["position"], abs=1e-6)
        assert whole["zoom"] == start["zoom"]
        page.keyboard.press("x")
        assert (state(page)["section"]["axis"], state(page)["section"]["on"]) == ("x", True)
        page.keyboard.press("s")
        assert not state(page)["section"]["on"]


def test_everything_is_reached_by_tab(browser: Browser, tmp_path: Path) -> None:
    second = replace(sheared(), name="second")
    reached = []
    with shown(browser, tmp_path, [sheared(), second]) as page:
        for _ in range(14):
            page.keyboard.press("Tab")
            reached.append(
                page.evaluate(
                    """() => {
                      const at = document.activeElement.shadowRoot?.activeElement;
                      return at && (at.getAttribute("aria-label") || at.textContent);
                    }"""
                )
            )
    expected = ["A <block>", "Mouse and keys", "Play", "Frame", "Colours show", "Section"]
    assert reached[: len(expected)] == expected
    assert {"block", "second", "Whole view", "Save the picture as PNG"} <= set(reached) | {
        label for label in ("block", "second") if reached.count("") >= 2
    }


def test_the_mouse_turns_and_the_wheel_zooms_once_the_view_has_the_focus(
    browser: Browser, tmp_path: Path
) -> None:
    with shown(browser, tmp_path, [sheared()], text="<div style='height: 3000px'></div>") as page:
        start = state(page)["camera"]
        page.mouse.move(600, 300)
        page.mouse.wheel(0, -200)
        assert state(page)["camera"]["zoom"] == start["zoom"]
        page.mouse.down()
        page.mouse.move(660, 320, steps=4)
        page.mouse.up()
        turned = state(page)["camera"]
        assert turned["position"] != pytest.approx(start["position"])
        page.mouse.wheel(0, -200)
        page.wait_for_timeout(100)
        assert state(page)["camera"]["zoom"] > 1.05 * start["zoom"]


def test_a_section_shows_the_wall_filled_and_the_cavity_open(
    browser: Browser, tmp_path: Path
) -> None:
    points, triangles = hollow(20, 4)
    cube = Surface("cube", triangles, points, colour="#336699")
    with shown(browser, tmp_path, [cube], view="front") as page:
        closed = pixels(page)
        page.get_by_role("button", name="Section", exact=True).click()
        about = state(page)["section"]
        cut = pixels(page)
    assert about == {"axis": "y", "offset_mm": 10, "on": True, "flip": True, "caps": 1}
    rows, columns = np.nonzero(drawn(closed))
    top, bottom, left, right = rows.min(), rows.max(), columns.min(), columns.max()
    middle, side = (top + bottom) // 2, (bottom - top) / 20
    wall = cut[middle, int(left + 1 * side) : int(left + 3 * side)]
    cavity = cut[middle, int(left + 7 * side) : int(right - 7 * side)]
    assert len(np.unique(wall, axis=0)) > 1, "the wall is hatched"
    assert len(np.unique(cavity, axis=0)) == 1, "the back of the cavity is plain"
    assert np.abs(cavity[0] - wall).sum(axis=1).min() > 20


def test_open_surfaces_that_close_each_other_are_filled_together(
    browser: Browser, tmp_path: Path
) -> None:
    points, triangles = block(10, 10, 10)
    halves = [Surface("one", triangles[:5], points), Surface("other", triangles[5:], points)]
    with shown(browser, tmp_path, [*halves]) as page:
        found = state(page)
        assert [surface["closed"] for surface in found["surfaces"]] == [False, False]
        assert found["section"]["caps"] == 1
    with shown(browser, tmp_path, [halves[0]]) as page:
        assert state(page)["section"]["caps"] == 0


def test_joints_that_are_divided_otherwise_are_closed_and_open_ends_are_not(
    browser: Browser, tmp_path: Path
) -> None:
    """A pipe of square section: once its end is closed by triangles about a middle of their own."""
    points, triangles = block(10, 10, 40)
    sides = triangles[4:]
    lids = np.array([[0, 0, 0], [0, 10, 0], [10, 10, 0], [10, 0, 0], [5, 0, 0], [5, 10, 0]], float)
    lids = np.vstack([lids, np.add(lids, (0, 0, 40))])
    fans = [[0, 1, 5], [0, 5, 4], [4, 5, 2], [4, 2, 3]]
    both = np.vstack([fans, np.array(fans)[:, ::-1] + 6])
    everything = np.vstack([points, lids])
    pipe = Surface("pipe", sides, points)
    closed = Surface("closed", np.vstack([sides, both + 8]), everything)
    half = Surface("half", np.vstack([sides, np.array(fans) + 8]), everything)
    with shown(browser, tmp_path, [closed]) as page:
        for surface, expected in ((closed, True), (pipe, False), (half, False)):
            show(page, surface)
            found = state(page)
            assert found["surfaces"][0]["closed"] is expected, surface.name
            assert found["section"]["caps"] == int(expected)


def test_thin_triangles_make_no_sharp_edges(browser: Browser, tmp_path: Path) -> None:
    """Along a diagonal of the top two triangles 0.4 µm wide stand steeply, 2 µm high."""
    points, triangles = block(40, 10, 10)
    middle, aside = np.array([20.0, 5.0, 10.0]), np.array([1.0, -4.0, 0.0]) * 2e-4 / 17**0.5
    p, q = 8, 9
    everything = np.vstack([points, middle + aside, middle - aside + [0, 0, 2e-3]])
    top = [(7, 6, p), (7, p, 4), (6, 5, q), (5, 4, q), (p, 6, q), (p, q, 4)]
    parted = np.array([tri for tri in triangles.tolist() if set(tri) - {4, 5, 6, 7}] + top)
    surfaces = [Surface("block", triangles, points), Surface("parted", parted, everything)]
    with shown(browser, tmp_path, [*surfaces]) as page:
        assert [(each["closed"], each["sharp_edges"]) for each in state(page)["surfaces"]] == [
            (True, 12),
            (True, 12),
        ]


def test_the_section_s_slider_and_axis_move_the_plane(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path, [sheared()]) as page:
        offset = page.get_by_label("Place of the section, mm")
        assert not offset.is_visible()
        page.get_by_role("button", name="Section", exact=True).click()
        page.get_by_label("Axis of the section").select_option("x")
        assert (offset.get_attribute("min"), offset.get_attribute("max")) == ("0", "60")
        offset.fill("15")
        found = state(page)["section"]
        assert (found["axis"], found["on"]) == ("x", True)
        assert found["offset_mm"] == pytest.approx(15)
        page.get_by_label("Cut away the other half").click()
        assert state(page)["section"]["flip"] is not found["flip"]


def test_the_legend_says_the_field_its_unit_its_range_and_the_limit(
    browser: Browser, tmp_path: Path
) -> None:
    with shown(browser, tmp_path, [sheared()]) as page:
        assert not state(page)["legend"]["shown"]
        page.get_by_label("Colours show").select_option("von Mises stress")
        found = state(page)
        assert found["range"] == {"low": 0, "high": 1} and found["limit"] == 0.8
        assert found["legend"] == {
            "shown": True,
            "title": "von Mises stress, MPa",
            "ticks": ["0", "0.2", "0.4", "0.6", "0.8", "1"],
            "limit": "limit 0.8",
        }
        place = page.locator(".legend-limit").bounding_box()
        scale = page.locator(".legend-scale").bounding_box()
        assert place is not None and scale is not None
        middle = place["y"] + place["height"] / 2
        assert middle == pytest.approx(scale["y"] + 0.2 * scale["height"], abs=1)
        told(page, "setField('von Mises stress', { low: 0, high: 2, limit: 1.5 })")
        assert state(page)["legend"]["ticks"] == ["0", "0.5", "1", "1.5", "2"]
        assert state(page)["legend"]["limit"] == "limit 1.5"
        told(page, "setField('wall thickness')")
        assert page.locator(".legend-missing").text_content() == "no value"
        told(page, "setField(null)")
        assert not state(page)["legend"]["shown"]


def test_colours_are_those_of_the_values(browser: Browser, tmp_path: Path) -> None:
    """The front of a block whose left half is 0 and whose right half is 1, seen from the front."""
    points, triangles = block(40, 10, 10)
    field = Field("share", "", (points[:, 0] > 20) * 1.0)
    surface = Surface("block", triangles, points, (field,))
    with shown(browser, tmp_path, [surface], view="front", field="share") as page:
        picture = pixels(page)
    rows, columns = np.nonzero(drawn(picture))
    middle = (rows.min() + rows.max()) // 2
    left, right = (picture[middle, end] for end in (columns.min() + 6, columns.max() - 6))
    assert left[2] > left[1] and left[2] > left[0] * 0.9, "violet"
    assert right[0] > 180 and right[1] > 180 and right[2] < 120, "yellow"


def test_the_value_is_read_where_the_mouse_points(browser: Browser, tmp_path: Path) -> None:
    """On the front of a block the value is x / 40: at a quarter of its length 0.25."""
    points, triangles = block(40, 10, 10)
    field = Field("share", "MPa", points[:, 0] / 40)
    surface = Surface("block", triangles, points, (field,))
    with shown(browser, tmp_path, [surface], view="front", field="share") as page:
        rows, columns = np.nonzero(drawn(pixels(page)))
        left, right = columns.min(), columns.max() + 1
        y = (rows.min() + rows.max()) / 2
        for share in (0.25, 0.6):
            call = f"readValue({left + share * (right - left)}, {y})"
            value = page.evaluate(f"async () => (await {FIRST}).{call}")
            assert value == pytest.approx(share, abs=0.01)
        assert page.evaluate(f"async () => (await {FIRST}).readValue(3, 3)") is None
        box = page.locator(".stage").bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + left + 0.25 * (right - left), box["y"] + y)
        page.wait_for_function(f"async () => !(await {FIRST}).value.hidden")
        assert page.locator(".value").text_content() == "0.25 MPa"


def test_behind_a_section_the_inside_is_read(browser: Browser, tmp_path: Path) -> None:
    points, triangles = hollow(20, 4)
    field = Field("depth", "mm", points[:, 1])
    cube = Surface("cube", triangles, points, (field,))
    with shown(browser, tmp_path, [cube], view="front", field="depth") as page:
        call = f"async () => {{ const v = await {FIRST}; v.render(); return v.readValue(%s); }}"
        middle = page.evaluate(f"async () => (await {FIRST}).stage.clientWidth / 2")
        assert page.evaluate(call % f"{middle}, 215") == pytest.approx(0, abs=1e-3)
        told(page, "setSection({ on: true })")
        assert page.evaluate(call % f"{middle}, 215") == pytest.approx(16, abs=1e-2)


def _at_rest(page: Page) -> float:
    """How far down the page is, once it scrolls no more: it goes on after a finger has left."""
    scrolled: float = page.evaluate(
        """async () => {
            let before = NaN
            for (let still = 0; still < 10; still = window.scrollY === before ? still + 1 : 0) {
                before = window.scrollY
                await new Promise(requestAnimationFrame)
            }
            return before
        }"""
    )
    return scrolled


def test_a_finger_turns_sideways_and_scrolls_upwards(browser: Browser, tmp_path: Path) -> None:
    below = "<div style='height: 3000px'></div>"
    with shown(browser, tmp_path, [sheared()], text=below, has_touch=True) as page:
        session = page.context.new_cdp_session(page)

        def touch(kind: str, *places: tuple[float, float]) -> None:
            points = [{"x": x, "y": y} for x, y in places]
            session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        def swipe(right: float, down: float) -> None:
            touch("touchStart", (400, 250))
            for step in range(1, 11):
                touch("touchMove", (400 + right * step / 10, 250 + down * step / 10))
            touch("touchEnd")

        start = state(page)["camera"]
        swipe(0, -150)
        page.wait_for_function("scrollY > 50")
        assert state(page)["camera"]["position"] == pytest.approx(start["position"], abs=1e-6)
        assert _at_rest(page) > 50
        page.evaluate("scrollTo(0, 0)")
        swipe(120, 0)
        assert _at_rest(page) == 0
        assert state(page)["camera"]["position"] != pytest.approx(start["position"], abs=1)


def test_a_surface_is_hidden_by_its_box(browser: Browser, tmp_path: Path) -> None:
    points, triangles = block(10, 10, 10)
    edge = Lines("edge", np.array([[0, 1]]), points + 20, "#ff0000")
    surfaces: list[Shown] = [sheared(), Surface("lid", triangles, points + 12), edge]
    with shown(browser, tmp_path, surfaces) as page:
        page.get_by_label("lid").uncheck()
        assert [each["visible"] for each in state(page)["surfaces"]] == [True, False, True]
        told(page, "setVisible('lid', true)")
        assert page.get_by_label("lid").is_checked()
        told(page, "setColour('block', '#00ff00')")
        assert state(page)["surfaces"][0]["colour"] == "#00ff00"


def test_another_scene_of_the_same_cells_keeps_the_view(browser: Browser, tmp_path: Path) -> None:
    moved = replace(sheared(), positions=np.asarray(sheared().positions) * [1, 1.5, 1])
    with shown(browser, tmp_path, [sheared()], frame=2, field="von Mises stress") as page:
        page.keyboard.press("Tab")
        page.keyboard.press("ArrowLeft")
        before = state(page)
        show(page, moved)
        after = state(page)
    assert after["camera"] == before["camera"] and after["frame"] == 2
    assert after["field"] == "von Mises stress"
    rest, grown = (np.array(each["surfaces"][0]["sample"]) for each in (before, after))
    np.testing.assert_allclose(grown[:, 1], 1.5 * rest[:, 1], atol=1e-2)


def test_the_scale_bar_is_as_long_as_it_says(browser: Browser, tmp_path: Path) -> None:
    points, triangles = block(40, 10, 10)
    with shown(browser, tmp_path, [Surface("block", triangles, points)], view="front") as page:
        columns = np.flatnonzero(drawn(pixels(page)).any(axis=0))
        bar = page.locator(".scale-bar i").bounding_box()
        length = state(page)["scale_bar_mm"]
    assert bar is not None
    pixels_per_mm = (columns.max() - columns.min() + 1) / 40
    assert bar["width"] == pytest.approx(length * pixels_per_mm, abs=2)


def test_play_runs_through_the_frames_and_stops(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path, [sheared()]) as page:
        page.get_by_role("button", name="Play").click()
        page.wait_for_function(f"async () => (await {FIRST}).frame > 0.5")
        page.get_by_role("button", name="Pause").click()
        stopped = state(page)["frame"]
        page.wait_for_timeout(200)
        assert state(page)["frame"] == stopped and not state(page)["playing"]


def test_less_motion_shows_whole_frames_only(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path, [sheared()], calm=True) as page:
        frames = page.evaluate(
            f"""async () => {{
              const viewer = await {FIRST};
              const seen = [];
              viewer.addEventListener("frame", () => seen.push(viewer.frame));
              viewer.play(true);
              await new Promise((done) => setTimeout(done, 2300));
              viewer.play(false);
              return seen;
            }}"""
        )
    assert frames and frames == [round(frame) for frame in frames]


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [NARROW, 1280])
def test_it_fits_and_is_readable(browser: Browser, tmp_path: Path, width: int, theme: str) -> None:
    surfaces: list[Shown] = [sheared(), replace(sheared(), name="another", fields=())]
    options: dict[str, Any] = {"width": width, "theme": theme, "section": "y"}
    with shown(browser, tmp_path, surfaces, field="von Mises stress", **options) as page:
        assert wider_than_the_window(page) == 0
        assert hard_to_read(page) == []
        boxes = [
            element.bounding_box() for element in page.locator(".bar :is(button, select)").all()
        ]
        places = [(box["x"], box["y"], box["width"], box["height"]) for box in boxes if box]
        assert len(places) == len(boxes) == 7
        assert all(x >= 0 and x + wide <= width for x, _, wide, _ in places)
        for (x, y, wide, high), (x2, y2, wide2, high2) in combinations(places, 2):
            beside = x + wide <= x2 or x2 + wide2 <= x
            assert beside or y + high <= y2 or y2 + high2 <= y, "controls overlap"


@pytest.mark.parametrize("width", [NARROW, 1280])
def test_a_block_of_few_points_beside_many_is_seen_whole(
    browser: Browser, tmp_path: Path, width: int
) -> None:
    """As the sockets of actuators: it reaches farther than all of the fine mesh beside it."""
    fine = bent_grid(9000, 1)
    corners, triangles = block(30, 60, 30)
    points = np.vstack([fine.positions[0], corners - (40, 20, 10)])
    whole = Surface("part", np.vstack([fine.triangles, triangles + len(fine.positions[0])]), points)
    with shown(browser, tmp_path, [whole], width=width) as page:
        picture = drawn(pixels(page))
        assert picture.any()
        for border in (picture[0], picture[-1], picture[:, 0], picture[:, -1]):
            assert not border.any()


def test_dark_and_light_pages_have_dark_and_light_stages(browser: Browser, tmp_path: Path) -> None:
    stage = f"async () => getComputedStyle((await {FIRST}).stage).backgroundColor"
    for theme, colour in (("light", "rgb(243, 245, 248)"), ("dark", "rgb(21, 27, 34)")):
        with shown(browser, tmp_path, [sheared()], theme=theme) as page:
            assert page.evaluate(stage) == colour
            for chosen, other in (("light", "rgb(243, 245, 248)"), ("dark", "rgb(21, 27, 34)")):
                page.evaluate(f"document.documentElement.dataset.theme = '{chosen}'")
                page.wait_for_timeout(50)
                assert page.evaluate(stage) == other


def test_without_webgl_a_sentence_says_so(browser: Browser, tmp_path: Path) -> None:
    file = tmp_path / "page.html"
    file.write_text(viewer_page([sheared()]), "utf-8")
    hide = "HTMLCanvasElement.prototype.getContext = () => null"
    context = browser.new_context()
    context.add_init_script(hide)
    page = context.new_page()
    page.goto(file.as_uri())
    said = page.get_by_role("alert").first
    said.wait_for()
    assert "no 3D here" in (said.text_content() or "")
    context.close()


def test_a_lost_graphics_card_is_told_and_comes_back(browser: Browser, tmp_path: Path) -> None:
    with shown(browser, tmp_path, [sheared()]) as page:
        lose = "renderer.getContext().getExtension('WEBGL_lose_context')"
        page.evaluate(
            f"async () => {{ window.card = (await {FIRST}).{lose}; card.loseContext(); }}"
        )
        page.get_by_role("alert").wait_for()
        assert state(page)["lost"]
        page.evaluate("card.restoreContext()")
        page.wait_for_function(f"async () => !(await {FIRST}).lost")
        told(page, "setFrame(3)")
        page.wait_for_timeout(200)
        assert drawn(pixels(page)).mean() > 0.02


def test_views_far_below_wait_until_they_come_near_and_all_start_for_print(
    browser: Browser, tmp_path: Path
) -> None:
    views = "<div style='height: 4000px'></div>".join(
        viewer_element([replace(sheared(), name=name)], label=name) for name in ("a", "b", "c")
    )
    file = tmp_path / "page.html"
    style = f"<style>{page_style()}</style>"
    file.write_text(f"<!DOCTYPE html><meta charset=utf-8>{style}{views}{viewer_script()}", "utf-8")
    with opened(browser, file) as (page, seen):
        page.wait_for_selector(".bellows-view[data-ready]")
        assert page.locator(".bellows-view[data-ready]").count() == 1
        page.evaluate("async () => { await Bellows.startAll(); }")
        assert page.locator(".bellows-view[data-ready]").count() == 3
        assert seen.all == []


def test_a_strict_policy_that_admits_the_page_s_own_by_nonce_is_kept(
    browser: Browser, tmp_path: Path
) -> None:
    policy = "default-src 'none'; script-src 'nonce-abc'; style-src 'nonce-abc'"
    meta = f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
    style = f'<style nonce="abc">{page_style()}</style>'
    view = viewer_element([sheared()], section="y")
    file = tmp_path / "page.html"
    page_text = f"<!DOCTYPE html><meta charset=utf-8>{meta}{style}{view}{viewer_script('abc')}"
    file.write_text(page_text, "utf-8")
    with opened(browser, file) as (page, seen):
        page.wait_for_selector(".bellows-view[data-ready]")
        page.get_by_label("Frame", exact=True).fill("2")
        assert state(page)["frame"] == 2
        stage = page.locator(".stage").bounding_box()
        assert stage is not None and stage["height"] == 420
        assert drawn(pixels(page)).mean() > 0.02
        assert seen.all == []


def test_the_picture_is_a_png_with_the_legend(browser: Browser, tmp_path: Path) -> None:
    from io import BytesIO

    from PIL import Image

    with shown(browser, tmp_path, [sheared()], field="von Mises stress") as page:
        address = page.evaluate(f"async () => (await {FIRST}).picture()")
    picture = Image.open(BytesIO(base64.b64decode(address.split(",")[1]))).convert("RGB")
    colours = np.asarray(picture, dtype=int)[:200, -120:].reshape(-1, 3)
    yellow = (colours[:, 0] > 230) & (colours[:, 1] > 210) & (colours[:, 2] < 90)
    assert yellow.sum() > 10, "the upper end of the legend"


def test_names_are_text_and_no_markup(browser: Browser, tmp_path: Path) -> None:
    evil = "<img src=x onerror=document.title='caught'>"
    surface = sheared()
    field = replace(surface.fields[0], name=evil, unit=evil)
    named = [replace(surface, name=f"{evil}{number}", fields=(field,)) for number in (1, 2)]
    with shown(browser, tmp_path, [*named], field=evil, label=evil) as page:
        assert page.title() == "A <block>"
        assert evil in page.locator(".legend-title").text_content()


def test_broken_data_are_told_in_a_sentence(browser: Browser, tmp_path: Path) -> None:
    file = tmp_path / "page.html"
    text = viewer_page([sheared()])
    begin = text.index("base64", text.index("octet-stream+base64")) + len('base64">')
    file.write_text(text[:begin] + "AAAA" + text[begin + 4 :], "utf-8")
    with opened(browser, file) as (page, _):
        said = page.get_by_role("alert").last
        said.wait_for()
        assert "cannot be shown" in (said.text_content() or "")


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"field": "strain"}, "no surface has a field “strain”: von Mises stress, wall thickness"),
        ({"frame": 5}, "there is no frame 5: the last one is 4"),
        ({"controls": ["frames", "sound"]}, "no control “sound”: frames, fields"),
    ],
)
def test_a_start_that_cannot_be_shown_is_refused(options: dict[str, Any], sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        viewer_element([sheared()], **options)
