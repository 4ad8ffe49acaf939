"""The page's own logic, against a server whose answers are known in closed form."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from browser import NARROW, hard_to_read, opened, wider_than_the_window
from pretended_studio import PretendedStudio, angle_of, stress_of

from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design

pytestmark = pytest.mark.browser

REST_MS = 120


def _design(*changes: str) -> Design:
    return with_overrides(load_design("prototype_1"), changes)


def _slider(page: Any, name: str) -> Any:
    return page.locator(f'[data-parameter="{name}"] input[type=range]')


def _field(page: Any, name: str) -> Any:
    return page.locator(f'[data-parameter="{name}"] input[type=text]')


def _type(page: Any, name: str, text: str) -> None:
    _field(page, name).fill(text)
    _field(page, name).press("Enter")


def _settle(page: Any, state: str = "refined") -> None:
    page.wait_for_timeout(REST_MS + 30)
    page.locator(f"#figures[data-state={state}]").wait_for()


def _expect_angle(page: Any, design: Design) -> None:
    _settle(page)
    shown = page.locator("#angle")
    assert shown.inner_text() == f"{angle_of(design):.1f}"
    assert float(shown.get_attribute("data-deg")) == pytest.approx(angle_of(design))


def test_first_answer_is_shown_with_its_error_and_limit(page: Any) -> None:
    _expect_angle(page, _design())
    figures = page.locator("#figures").inner_text()
    assert f"± {0.025 * angle_of(_design()):.1f}" in figures
    assert f"{stress_of(_design()) / 4:.0%}".replace("%", " %") in figures
    assert page.locator("#state").inner_text() == "refined"
    assert "Fit to be printed" in page.locator("#verdict").inner_text()


def test_arrow_keys_on_a_slider_move_by_one_step(page: Any) -> None:
    _slider(page, "bubble_height").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("PageUp")
    _expect_angle(page, _design("bubble_height=21.1"))


def test_mouse_moves_a_slider_and_the_drag_is_one_step_of_the_history(page: Any) -> None:
    box = _slider(page, "bubble_height").bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] / 2, middle)
    page.mouse.down()
    for share in (0.55, 0.6):  # it rests twice on the way
        page.mouse.move(box["x"] + share * box["width"], middle, steps=3)
        page.wait_for_timeout(REST_MS + 80)
    page.mouse.up()
    _settle(page)
    moved = float(_field(page, "bubble_height").input_value())
    assert moved > 20
    _expect_angle(page, _design(f"bubble_height={moved}"))
    page.keyboard.press("Control+z")
    _expect_angle(page, _design())


DRAG = """(range, value) => {
  range.dispatchEvent(new PointerEvent("pointerdown"));
  range.value = value;
  range.dispatchEvent(new Event("input"));
  range.dispatchEvent(new PointerEvent("pointerup"));
}"""


def test_two_drags_without_a_rest_between_them_are_two_steps(page: Any) -> None:
    for name in ("bubble_height", "bubble_width"):
        _slider(page, name).evaluate(DRAG, 22)
    _expect_angle(page, _design("bubble_height=22", "bubble_width=22"))
    page.locator("#undo").click()
    _expect_angle(page, _design("bubble_height=22"))
    page.locator("#undo").click()
    _expect_angle(page, _design())


def test_typed_number_may_have_a_comma(page: Any) -> None:
    _type(page, "bubble_height", "18,25")
    _expect_angle(page, _design("bubble_height=18.25"))


@pytest.mark.parametrize("text", ["abc", "900", "1.000,5"])
def test_text_that_is_no_possible_number_is_refused_beside_its_field(
    page: Any, studio: PretendedStudio, text: str
) -> None:
    before = len(studio.received)
    _type(page, "bubble_height", text)
    problem = page.locator('[data-parameter="bubble_height"] .problem')
    assert "4 to 200 mm" in problem.inner_text()
    page.keyboard.press("Escape")
    assert _field(page, "bubble_height").input_value() == "20"
    assert problem.is_hidden()
    assert len(studio.received) == before


def test_changes_hold_only_what_differs_and_a_rest_follows_the_last(
    page: Any, studio: PretendedStudio
) -> None:
    studio.received.clear()
    _slider(page, "bubble_width").focus()
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    _settle(page)
    assert studio.last("change")["values"] == {"bubble_width": 20.5}
    rests = [each["revision"] for each in studio.received if each["type"] == "rest"]
    assert rests[-1] == studio.last("change")["revision"]
    assert rests == sorted(set(rests))
    revisions = [each["revision"] for each in studio.received]
    assert revisions == sorted(revisions)


def test_figures_of_an_older_design_are_never_shown_as_current(
    page: Any, studio: PretendedStudio
) -> None:
    studio.held = True
    _type(page, "bubble_height", "24")
    assert page.locator("#angle").get_attribute("data-state") == "old"
    assert "out of date" in page.locator("#figures .reading").first.inner_text()
    _settle(page, "computing")
    revision = studio.last("rest")["revision"]
    late = {"state": "refined", "bending_angle_deg": 1.0, "max_von_mises_mpa": 1.0,
            "cavity_volume_mm3": 1.0, "verdict": "pass"}  # fmt: skip
    studio.say("answer", revision=revision - 1, **late)
    page.wait_for_timeout(100)
    assert page.locator("#figures").get_attribute("data-state") == "computing"
    studio.say("answer", revision=revision, **late)
    page.locator("#figures[data-state=refined]").wait_for()
    assert page.locator("#angle").inner_text() == "1.0"


def test_figures_of_a_lower_pressure_than_the_designs_own_say_which(
    page: Any, studio: PretendedStudio
) -> None:
    revision = int(page.locator("#angle").get_attribute("data-revision"))
    studio.say("answer", revision=revision, state="refined", bending_angle_deg=1.0,
               max_von_mises_mpa=1.0, cavity_volume_mm3=1.0, verdict="fail", converged=False,
               pressure_mpa=0.00968, how="kept from before", message="it folds.")  # fmt: skip
    page.locator("#how", has_text="Kept from before. It folds.").wait_for()
    labels = page.locator("#figures .figure-label").all_inner_texts()
    assert all(label.endswith("– at 0.00968 MPa only") for label in labels)


def test_preview_never_replaces_the_refined_answer(page: Any, studio: PretendedStudio) -> None:
    revision = int(page.locator("#angle").get_attribute("data-revision"))
    studio.say("answer", revision=revision, state="preview", bending_angle_deg=1.0,
               max_von_mises_mpa=1.0, cavity_volume_mm3=1.0, verdict="pass")  # fmt: skip
    page.wait_for_timeout(100)
    assert page.locator("#state").inner_text() == "refined"
    assert page.locator("#angle").inner_text() != "1.0"


def test_invalid_combination_is_explained_beside_its_slider(page: Any) -> None:
    _type(page, "bubble_thickness", "9.9")
    row = page.locator('[data-parameter="bubble_thickness"]')
    row.locator(".problem").wait_for()
    assert "hollow" in row.locator(".problem").inner_text()
    assert page.locator("#stage-view.dimmed").count() == 1
    assert page.locator("#figures").get_attribute("data-state") == "invalid"
    assert page.locator("#save").is_disabled()
    page.keyboard.press("Escape")
    page.locator("#undo").click()
    _expect_angle(page, _design())
    assert page.locator("#stage-view.dimmed").count() == 0
    assert row.locator(".problem").is_hidden()


def test_shape_that_follows_leaves_the_one_before_pale(page: Any, studio: PretendedStudio) -> None:
    studio.held = True
    _type(page, "bubble_height", "24")
    _settle(page, "computing")
    revision = studio.last("rest")["revision"]
    studio.say("shape_follows", revision=revision, why="the shape has other faces than before")
    page.locator("#stage-view.dimmed").wait_for()
    assert "follows" in page.locator("#view-note").inner_text()
    studio.held = False
    _type(page, "bubble_height", "25")
    _settle(page)
    assert page.locator("#stage-view.dimmed").count() == 0


def test_undo_and_redo_walk_through_the_rests(page: Any) -> None:
    for height in ("21", "22"):
        _type(page, "bubble_height", height)
        _settle(page)
    page.locator("h1").click()
    page.keyboard.press("Control+z")
    _expect_angle(page, _design("bubble_height=21"))
    page.locator("#undo").click()
    _expect_angle(page, _design())
    assert page.locator("#undo").is_disabled()
    page.keyboard.press("Control+y")
    page.keyboard.press("Control+Shift+z")
    _expect_angle(page, _design("bubble_height=22"))
    assert page.locator("#redo").is_disabled()


def test_reset_goes_back_to_the_opened_design_and_can_be_undone(page: Any) -> None:
    _type(page, "bubble_height", "23")
    _settle(page)
    assert page.locator("#design-changed").is_visible()
    page.locator("#reset").click()
    _expect_angle(page, _design())
    assert page.locator("#design-changed").is_hidden()
    page.locator("#undo").click()
    _expect_angle(page, _design("bubble_height=23"))


def test_changes_are_asked_about_before_the_page_is_loaded_anew(page: Any) -> None:
    asked: list[str] = []
    page.on("dialog", lambda dialog: (asked.append(dialog.type), dialog.accept()))
    page.reload()
    _settle(page)
    assert not asked
    _type(page, "bubble_height", "23")
    _settle(page)
    with page.expect_download():
        page.locator("#save").click()
    assert not asked
    page.reload()
    assert asked == ["beforeunload"]
    _expect_angle(page, _design())


def test_comparison_says_that_bubbles_were_as_many_as_fit(page: Any) -> None:
    page.locator("#pin").click()
    page.locator("label[for=p-number_of_bubbles-automatic]").click()
    _type(page, "number_of_bubbles", "3")
    page.locator("#pinned-differences li", has_text="as many as fit → 3").wait_for()


@pytest.mark.parametrize("width", [NARROW, 730, 1130, 1280])
def test_error_that_is_not_known_yet_stays_within_the_figures(
    browser: Any, studio: PretendedStudio, width: int
) -> None:
    with opened(browser, studio.url, width=width, calm=True) as (page, _):
        _settle(page)
        revision = int(page.locator("#angle").get_attribute("data-revision"))
        studio.say("answer", revision=revision, state="refined", bending_angle_deg=413.2,
                   max_von_mises_mpa=13.7, cavity_volume_mm3=11160.0, verdict="pass")  # fmt: skip
        page.locator("#angle", has_text="413.2").wait_for()
        boxes = [each.bounding_box() for each in page.locator("#figures .reading").all()]
        parts = [each.bounding_box() for each in page.locator("#figures .reading .margin").all()]
        for box, part in zip(boxes[:2], parts[:2], strict=True):
            assert part["x"] + part["width"] <= box["x"] + box["width"] + 1


def test_pinned_design_stays_in_view_and_figures_show_the_difference(page: Any) -> None:
    page.locator("#pin").click()
    _type(page, "bubble_height", "24")
    _expect_angle(page, _design("bubble_height=24"))
    gain = angle_of(_design("bubble_height=24")) - angle_of(_design())
    assert page.locator("#angle-compared").inner_text().startswith(f"+{gain:.3g}°")
    assert "bubble height: 20 → 24" in page.locator("#pinned-differences").inner_text()
    surfaces = page.locator("#canvas").get_by_role("checkbox", name="pinned")
    assert surfaces.count() == 1
    page.locator("#pinned-take").click()
    _expect_angle(page, _design())
    page.locator("#pinned-remove").click()
    assert page.locator("#angle-compared").is_hidden()


def test_blend_moves_the_shape_between_rest_and_pressure(page: Any) -> None:
    page.locator("#blend").focus()
    page.keyboard.press("Home")
    assert page.locator("#blend-text").inner_text() == "at rest"
    page.locator("label[for=mode-printed]").click()
    assert page.locator("#blend").is_disabled()
    page.locator("h1").click()
    page.keyboard.press("d")
    assert page.locator("#mode-pressure").is_checked()


def test_as_many_bubbles_as_fit_or_a_given_number(page: Any, studio: PretendedStudio) -> None:
    row = page.locator('[data-parameter="number_of_bubbles"]')
    box = row.get_by_label("as many as fit")
    assert box.is_checked() and _slider(page, "number_of_bubbles").is_disabled()
    box.uncheck()
    _type(page, "number_of_bubbles", "5")
    _expect_angle(page, _design("number_of_bubbles=5"))
    box.check()
    _expect_angle(page, _design())
    assert "number_of_bubbles" not in studio.last("change")["values"]


def test_number_that_follows_from_others_is_the_designs(page: Any) -> None:
    _type(page, "length", "60")
    _settle(page)
    expected = _design("length=60").bellows.bubble_count
    assert expected != _design().bellows.bubble_count
    assert _field(page, "number_of_bubbles").input_value() == str(expected)


def test_indent_is_switched_on_with_one_that_fits(page: Any, studio: PretendedStudio) -> None:
    page.locator("#indent-on").check()
    _settle(page)
    indent = studio.last("change")["values"]["indent"]
    assert indent["side"] == "outside" and indent["shape"] == "arc"
    page.locator("#indent-side").select_option("inside")
    _settle(page)
    assert studio.last("change")["values"]["indent"]["shape"] == "rectangular"
    page.locator("#indent-on").uncheck()
    _settle(page)
    assert studio.last("change")["values"] == {}


def test_sensitivity_stands_beside_its_slider_and_pales_when_it_is_old(
    page: Any, studio: PretendedStudio
) -> None:
    row = page.locator('[data-parameter="bubble_height"] .sensitivity')
    gain = angle_of(_design()) / 20 * 0.1
    assert row.inner_text() == f"↑ +0.1 mm: +{gain:.2g}°, ±0 MPa"
    studio.held = True
    _type(page, "bubble_height", "21")
    assert page.locator("#sliders.stale-sensitivities").count() == 1
    page.wait_for_timeout(2 * REST_MS)
    revision = studio.last("rest")["revision"]
    studio.say("answer", revision=revision, state="preview", bending_angle_deg=1.0,
               max_von_mises_mpa=1.0, cavity_volume_mm3=1.0, verdict="pass")  # fmt: skip
    page.locator("#figures[data-state=preview]").wait_for()
    assert page.locator("#sliders.stale-sensitivities").count() == 1


def test_saved_file_is_the_design_on_the_sliders(page: Any, tmp_path: Path) -> None:
    _type(page, "bubble_height", "21.5")
    _settle(page)
    with page.expect_download() as download:
        page.keyboard.press("Control+s")
    download.value.save_as(tmp_path / "saved.toml")
    assert download.value.suggested_filename == "prototype_1.toml"
    assert load_design(tmp_path / "saved.toml").digest == _design("bubble_height=21.5").digest


@pytest.mark.parametrize("text", ["x" * 1_000_001, "\n" * 600_000, "é" * 500_001])
def test_file_that_no_message_holds_is_refused_and_not_sent(
    page: Any, studio: PretendedStudio, tmp_path: Path, text: str
) -> None:
    studio.received.clear()
    file = tmp_path / "huge.toml"
    file.write_bytes(text.encode())
    page.locator("#open-file").set_input_files(file)
    page.locator("#open-problem", has_text="huge.toml has more than 1 MB").wait_for()
    assert not [each for each in studio.received if each["type"] == "open_toml"]


def test_own_file_is_opened_and_undo_leads_back_from_it(page: Any, tmp_path: Path) -> None:
    _type(page, "bubble_height", "21")
    _settle(page)
    file = tmp_path / "own.toml"
    file.write_text(_design("bubble_height=25", "name=mine").to_toml())
    page.locator("#open").click()
    page.locator("#open-file").set_input_files(file)
    page.locator("#design-name", has_text="mine").wait_for()
    _expect_angle(page, _design("bubble_height=25"))
    page.locator("#undo").click()
    page.locator("#design-name", has_text="prototype_1").wait_for()
    _expect_angle(page, _design("bubble_height=21"))


def test_dropped_file_is_opened(page: Any) -> None:
    text = _design("bubble_height=26").to_toml()
    page.evaluate(
        """text => {
            const files = new DataTransfer();
            files.items.add(new File([text], "dropped.toml"));
            document.body.dispatchEvent(new DragEvent("drop",
                {dataTransfer: files, bubbles: true, cancelable: true}));
        }""",
        text,
    )
    _expect_angle(page, _design("bubble_height=26"))


def test_file_that_is_no_design_says_why_and_leaves_the_design(page: Any, tmp_path: Path) -> None:
    file = tmp_path / "broken.toml"
    file.write_text("name = ")
    page.locator("#open").click()
    page.locator("#open-file").set_input_files(file)
    page.locator("#open-problem", has_text=re.compile(r"\w")).wait_for()
    page.keyboard.press("Escape")
    _expect_angle(page, _design())


def test_lost_connection_is_said_and_the_changes_come_back(
    page: Any, studio: PretendedStudio
) -> None:
    _type(page, "bubble_height", "22")
    _settle(page)
    studio.stop()
    page.locator("#banner", has_text="lost").wait_for()
    _type(page, "bubble_width", "21")
    page.locator("#state", has_text="not connected").wait_for()
    assert page.locator("#save").is_disabled() and page.locator("#run").is_disabled()
    studio.received.clear()
    studio.start()
    page.locator("#banner", has_text="Connected again").wait_for(timeout=15_000)
    _expect_angle(page, _design("bubble_height=22", "bubble_width=21"))
    assert page.locator("#save").is_enabled() and page.locator("#run").is_enabled()
    assert studio.last("open_toml")["text"] == _design().to_toml()
    assert studio.last("change")["values"] == {"bubble_height": 22, "bubble_width": 21}
    page.locator("#undo").click()
    _expect_angle(page, _design("bubble_height=22"))


def test_what_is_being_typed_outlives_a_new_connection(page: Any, studio: PretendedStudio) -> None:
    field = _field(page, "bubble_height")
    field.fill("23")
    studio.cut()
    page.locator("#banner", has_text="lost").wait_for()
    page.locator("#banner", has_text="Connected again").wait_for(timeout=15_000)
    page.keyboard.press("Enter")
    _expect_angle(page, _design("bubble_height=23"))


def test_page_that_is_one_too_many_says_why_and_comes_in_once_there_is_room(
    page: Any, studio: PretendedStudio
) -> None:
    studio.refusal = (1013, b"8 pages are open already")
    studio.cut()
    page.locator("#banner", has_text="8 pages are open already. Trying again").wait_for()
    page.wait_for_timeout(2500)  # it is turned away again, ever later
    assert "8 pages" in page.locator("#banner").inner_text()
    studio.refusal = None
    page.locator("#banner", has_text="Connected again").wait_for(timeout=15_000)


def test_studio_that_was_ended_is_said_to_have_ended_until_it_is_back(
    page: Any, studio: PretendedStudio
) -> None:
    studio.cut(1001)
    studio.stop()
    page.locator("#banner", has_text="The studio has ended").wait_for()
    page.wait_for_timeout(800)  # what fails now has no code
    assert "The studio has ended" in page.locator("#banner").inner_text()
    studio.start()
    page.locator("#banner", has_text="Connected again").wait_for(timeout=15_000)


def test_first_connection_is_waited_for_and_not_called_lost(
    browser: Any, studio: PretendedStudio
) -> None:
    studio.held = True
    with opened(browser, studio.url, calm=True) as (page, seen):
        page.locator("#state", has_text="waiting for the studio").wait_for()
        assert "again" not in page.locator("#figures").inner_text()
        assert page.locator("#banner").is_hidden()
        assert seen.all == []


@pytest.mark.parametrize("number", ["9.9", "1.3"])
def test_in_a_narrow_window_the_word_on_the_figures_covers_none_of_them(
    browser: Any, studio: PretendedStudio, number: str
) -> None:
    with opened(browser, studio.url, width=NARROW, calm=True) as (page, _):
        _settle(page)
        studio.refined_seconds = 60
        _type(page, "bubble_thickness", number)
        page.locator("#figures:not([data-state=refined]):not([data-state=moving])").wait_for()
        badge = page.locator("#state").bounding_box()
        for each in page.locator("#figures .reading").all():
            box = each.bounding_box()
            assert badge["y"] + badge["height"] <= box["y"] + 1


def test_scene_says_what_is_computed(page: Any, studio: PretendedStudio) -> None:
    page.locator("#tab-forces").click()
    studio.held = True
    page.locator("#scene-run").click()
    page.locator("#scene-status", has_text="Computing").wait_for()
    studio.held = False
    revision = int(page.locator("#angle").get_attribute("data-revision"))
    for message, fraction in (("mesh 2", None), ("", 0.5)):
        studio.say("working", revision=revision, what="scene", message=message, fraction=fraction)
    page.locator("#scene-status", has_text="Computing… mesh 2, 50 %").wait_for()


def test_scene_is_asked_for_with_its_keys_and_shown_as_a_picture(
    page: Any, studio: PretendedStudio
) -> None:
    page.locator("#tab-forces").click()
    page.locator("label[for=scene-blocked]").click()
    page.locator("#scene-field-support").select_option("wall")
    page.locator("#scene-field-distance").fill("2,5")
    page.locator("#scene-run").click()
    page.locator("#scene-figures", has_text="1.23 N ± 4 %").wait_for()
    notes = page.locator("#scene-notes li").all_inner_texts()
    assert notes == ["At 0.05 MPa it slips.", "mass_g is large."]
    assert page.locator("#scene-caption").inner_text() == "Darker: later."
    asked = studio.last("scene")
    assert asked["scene"] == "blocked" and asked["support"] == "wall" and asked["distance"] == 2.5
    width = page.locator("#scene-picture").evaluate(
        "image => image.decode().then(() => image.naturalWidth)"
    )
    assert width > 0


def test_run_gives_verdict_and_files(page: Any) -> None:
    page.locator("#run").click()
    page.locator("#run-status", has_text="Approved").wait_for()
    link = page.locator("#run-files a")
    assert link.inner_text() == "part.stl"
    assert link.get_attribute("href").startswith("/exports/part/part.stl")


def test_text_of_others_stays_text(page: Any, studio: PretendedStudio) -> None:
    revision = int(page.locator("#angle").get_attribute("data-revision"))
    markup = "<img src=x onerror=\"document.title='taken'\">"
    light = {"rule": markup, "verdict": "fail", "message": markup}
    studio.say("lights", revision=revision, source="declared", lights=[light])
    studio.say(
        "problems", revision=revision, problems=[{"parameter": "bubble_width", "message": markup}]
    )
    page.locator("#lights", has_text="onerror").wait_for()
    assert page.locator("#lights img, #sliders img").count() == 0
    assert page.title() != "taken"


def test_all_controls_are_reached_and_named_for_the_keyboard(page: Any) -> None:
    reached = []
    page.locator("body").focus()
    for _ in range(120):
        page.keyboard.press("Tab")
        reached.append(
            page.evaluate(
                """() => { let at = document.activeElement;
               while (at.shadowRoot?.activeElement) at = at.shadowRoot.activeElement;
               return [at.id, at.ariaLabel || at.labels?.[0]?.textContent || at.textContent]; }"""
            )
        )
    identifiers = {identifier for identifier, _ in reached}
    assert {"open", "save", "run", "show-help", "p-bubble_width-range", "p-load-pressure-field",
            "choice-material", "mode-pressure", "blend", "indent-on"} <= identifiers  # fmt: skip
    assert [identifier for identifier, name in reached if identifier and not name.strip()] == []


@pytest.mark.parametrize("width", [400, 760, 1000, 1600])
def test_nothing_is_wider_than_the_window(page: Any, width: int) -> None:
    page.set_viewport_size({"width": width, "height": 800})
    assert wider_than_the_window(page) == 0


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_all_text_can_be_read_in_both_themes(page: Any, theme: str) -> None:
    page.emulate_media(color_scheme="dark" if theme == "light" else "light")
    for _ in range(3):  # as the system, light, dark
        if page.locator("#theme").get_attribute("data-theme") == theme:
            break
        page.locator("#theme").click()
    page.locator("#pin").click()
    _type(page, "bubble_height", "21")
    _settle(page)
    assert page.evaluate("document.documentElement.dataset.theme") == theme
    assert hard_to_read(page) == []
