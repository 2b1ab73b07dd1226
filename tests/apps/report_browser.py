#!/usr/bin/env python3
"""Opens a report in headless Chromium and uses it as a reader does: zooms, hovers, switches filters and views.

Usage: report_browser.py PAGE [SUMMARY] [--shots PREFIX]

Prints what is wrong and ends with 1; with 77 where Chromium or python3-websocket is missing. SUMMARY is the summary.json
whose numbers the page's tables must hold. --shots writes PREFIX_{400,1280}_{light,dark}.png.
"""
import argparse
import base64
import bisect
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request

SKIPPED = 77
BROWSER = next((path for path in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if path), None)
try:
    import websocket
except ImportError:
    websocket = None


class Browser:
    """One page, spoken to by the DevTools protocol."""

    def __init__(self, page):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.process = subprocess.Popen(
            [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
             "--remote-debugging-port=0", "--remote-allow-origins=*", f"--user-data-dir={self.profile.name}", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port = pathlib.Path(self.profile.name) / "DevToolsActivePort"
        wait(lambda: port.exists() and port.read_text().strip(), "the browser does not start")
        address = f"http://127.0.0.1:{port.read_text().split()[0]}/json"
        targets = json.load(urllib.request.urlopen(address, timeout=30))
        target = next(one for one in targets if one["type"] == "page")
        self.socket = websocket.create_connection(target["webSocketDebuggerUrl"], timeout=60)
        self.number = 0
        self.complaints = []
        for domain in ("Runtime", "Log", "Network", "Page"):
            self.call(domain + ".enable")
        self.size(1280, 900)
        self.call("Page.navigate", url=pathlib.Path(page).resolve().as_uri())
        wait(lambda: self.js("document.getElementById('page')?.dataset.drawn === 'yes'"), "the page does not finish")

    def call(self, method, **parameters):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv())
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]
            self.note(message)

    def note(self, message):
        method, told = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.complaints.append("exception: " + json.dumps(told["exceptionDetails"])[:400])
        if method == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
            self.complaints.append("console: " + json.dumps(told["args"])[:400])
        if method == "Log.entryAdded" and told["entry"]["level"] == "error":
            self.complaints.append("log: " + told["entry"]["text"])
        if method == "Network.requestWillBeSent" and not told["request"]["url"].startswith(("file:", "data:", "about:")):
            self.complaints.append("asks the network for " + told["request"]["url"])

    def js(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{expression}: {json.dumps(result['exceptionDetails'])[:400]}")
        return result["result"].get("value")

    def size(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)

    def mouse(self, kind, x, y, held=False):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left" if held or kind != "mouseMoved" else "none",
                  buttons=1 if held else 0, clickCount=1)

    def box(self, selector, number=0):
        """The place of an element, scrolled to the middle of the window."""
        return self.js(f"""(() => {{ const one = document.querySelectorAll({json.dumps(selector)})[{number}];
            one.scrollIntoView({{block: 'center'}}); const {{x, y, width, height}} = one.getBoundingClientRect();
            return {{x, y, width, height}}; }})()""")

    def close(self):
        self.socket.close()
        self.process.terminate()
        self.process.wait()
        self.profile.cleanup()


def wait(condition, complaint, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise RuntimeError(complaint)
        time.sleep(0.05)


class Failures:
    def __init__(self):
        self.all = []

    def expect(self, holds, what):
        if not holds:
            self.all.append(what)


AXES = "[...document.querySelectorAll('.lines')].map((one) => [...one.querySelectorAll('.dygraph-axis-label-x')].map((l) => l.textContent).join())"
PICTURES = "[...document.querySelectorAll('#view canvas:first-of-type')].filter((one) => one.getClientRects().length).map((one) => one.toDataURL().length + one.toDataURL().slice(-4000))"


def chosen_panels(data):
    """Those that are drawn when the page opens."""
    return data["panels"] + [panel for view in data["views"][:1] for panel in view["panels"]] + data["last"]


def panels_of(data, kind):
    return [panel for panel in chosen_panels(data) if panel["kind"] == kind]


def check_drawing(browser, failures, data):
    panels = chosen_panels(data)
    for kind, selector in (("lines", ".lines .chart canvas"), ("plan", ".plan .map path"), ("heat", ".heat rect"), ("intervals", ".intervals .interval path")):
        wanted = sum(panel["kind"] == kind for panel in panels)
        found = browser.js(f"new Set([...document.querySelectorAll({json.dumps(selector)})].map((one) => one.closest('figure'))).size")
        failures.expect(found >= wanted, f"{found} of {wanted} panels of kind {kind} are drawn")
    drawn = browser.js("""[...document.querySelectorAll('.lines .chart')].every((chart) => [...chart.querySelectorAll('canvas')].some((canvas) => {
        const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
        return new Set(new Uint32Array(pixels.buffer)).size > 3; }))""")
    failures.expect(drawn, "a chart has an empty canvas")
    titles = browser.js("[...document.querySelectorAll('h2')].map((one) => one.textContent)")
    for panel in panels:
        if panel["kind"] != "words":
            failures.expect(panel["title"] in titles, f"no title {panel['title']!r}")
    failures.expect(browser.js("document.querySelectorAll('b').length") == 0, "text of the data became an element")
    failures.expect(data["command"] in browser.js("document.querySelector('footer').textContent"), "no command at the foot")
    failures.expect(data["version"] in browser.js("document.querySelector('footer').textContent"), "no version at the foot")


def check_zoom(browser, failures):
    before = browser.js(AXES)
    box = browser.box("#view .lines .chart")
    middle = box["y"] + box["height"] / 2
    left, right = box["x"] + 0.4 * box["width"], box["x"] + 0.7 * box["width"]
    browser.mouse("mouseMoved", left, middle)
    browser.mouse("mousePressed", left, middle, held=True)
    for step in range(1, 6):
        browser.mouse("mouseMoved", left + (right - left) * step / 5, middle, held=True)
    browser.mouse("mouseReleased", right, middle)
    zoomed = browser.js(AXES)
    dragged = browser.js("[...document.querySelectorAll('.lines')].indexOf(document.querySelector('#view .lines'))")
    same_axis = [i for i, labels in enumerate(before) if labels == before[dragged]]
    failures.expect(all(zoomed[i] != before[i] for i in same_axis), "dragging does not zoom every chart")
    failures.expect(len({zoomed[i] for i in same_axis}) == 1, "the charts are not zoomed together")
    failures.expect(not browser.js("document.getElementById('reset').hidden"), "no way back from a zoom")
    browser.js("document.getElementById('reset').click()")
    failures.expect(browser.js(AXES) == before, "the way back from a zoom leads elsewhere")


def check_hover(browser, failures, data):
    box = browser.box(".lines .chart")
    browser.mouse("mouseMoved", box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    text = browser.js("document.querySelector('.lines .readout').textContent")
    panel = panels_of(data, "lines")[0]
    if "clock" in panel:
        failures.expect(text.startswith("time, UTC: 20"), f"hovering shows no clock time: {text!r}")
        return
    number = lambda value: "–" if value is None else json.loads(browser.js(f"JSON.stringify(String(Number(({value!r}).toPrecision(5))))"))
    at = text.split(":", 1)[-1].strip()
    rows = [k for k, x in enumerate(panel["x"]) if at.startswith(number(x))]
    right = any(all(f"{curve['name']} {number(curve['values'][k])}" in text for curve in panel["curves"])
                and panel.get("remarks", [""] * (k + 1))[k] in text for k in rows)
    failures.expect(right, f"hovering shows no row of the data: {text!r}")


def check_legend(browser, failures, data):
    browser.mouse("mouseMoved", 1, 1)
    names = [group["name"] for group in data["groups"]]
    panel = next(one for one in data["views"][0]["panels"] if one["kind"] == "lines")
    for name in names:
        if name not in [curve["group"] for curve in panel["curves"]]:
            continue
        before = browser.js(PICTURES)
        select = f"[...document.querySelectorAll('.bar input')].find((one) => one.dataset.group === {json.dumps(name)}).click()"
        browser.js(select)
        text = browser.js("[...document.querySelectorAll('#view .lines .readout span')].map((one) => one.textContent.trim())")
        failures.expect(name not in text, f"{name} is switched off and still named")
        failures.expect(browser.js(PICTURES) != before, f"switching {name} off changes no picture")
        browser.js(select)
        failures.expect(browser.js(PICTURES) == before, f"switching {name} on again does not bring it back")
        break


def check_intervals(browser, failures, data):
    """Pointing at a number says it and its interval, and a group that is switched off has none."""
    panel = next((one for one in chosen_panels(data) if one["kind"] == "intervals"), None)
    if panel is None:
        return
    hidden = {group["name"] for group in data["groups"] if not group["shown"]}
    shown = next(series for series in panel["series"] if series["group"] not in hidden)
    row = next(k for k, value in enumerate(shown["values"]) if value[0] is not None)
    number = row * sum(series["group"] not in hidden for series in panel["series"]) + [
        series["name"] for series in panel["series"] if series["group"] not in hidden].index(shown["name"])
    box = browser.box(".intervals .interval", number)
    browser.mouse("mouseMoved", box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    text = browser.js("document.querySelector('figure.intervals .readout').textContent")
    failures.expect(text == f"{panel['rows'][row]}, {shown['name']}: {shown['shown'][row]}", f"pointing at an interval says {text!r}")
    browser.mouse("mouseMoved", 1, 1)
    if not shown["group"]:
        return
    count = "document.querySelectorAll('figure.intervals')[0].querySelectorAll('.interval').length"
    before = browser.js(count)
    select = f"[...document.querySelectorAll('.bar input')].find((one) => one.dataset.group === {json.dumps(shown['group'])}).click()"
    browser.js(select)
    failures.expect(browser.js(count) == before - len(panel["rows"]), f"{shown['name']} is switched off and still drawn")
    browser.js(select)
    failures.expect(browser.js(count) == before, f"switching {shown['name']} on again does not bring it back")


def check_heat(browser, failures, data):
    """Pointing at a cell says its number and what it comes from."""
    panel = next((one for one in chosen_panels(data) if one["kind"] == "heat"), None)
    if panel is None:
        return
    box = browser.box(".heat .cell")
    browser.mouse("mouseMoved", box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    text = browser.js("document.querySelector('figure.heat .readout').textContent")
    words = [f"{panel['rows'][0]}, {panel['columns'][0]}: {panel['shown'][0][0]}"] + (panel["texts"][0][:1] if panel["texts"] else [])
    failures.expect(text == "; ".join(word for word in words if word), f"pointing at a cell says {text!r}")
    browser.mouse("mouseMoved", 1, 1)


def check_saving(browser, failures, data):
    """Each chart is saved as a picture with its title, which needs no other file."""
    saved = browser.js("""(async () => {
        const blobs = [], texts = [];
        URL.createObjectURL = (blob) => { blobs.push(blob); return '#'; };
        document.querySelectorAll('button.save').forEach((one) => { if (one.getClientRects().length) one.click(); });
        for (const blob of blobs) texts.push(new DOMParser().parseFromString(await blob.text(), 'image/svg+xml'));
        return texts.map((one) => [[...one.querySelectorAll('text')].map((text) => text.textContent).join(' '),
            one.querySelectorAll('image[href^="data:image/png"], svg svg path, svg svg rect').length, one.querySelectorAll('parsererror').length]); })()""")
    titles = [panel["title"] for panel in chosen_panels(data) if panel["kind"] not in ("table", "words")]
    shown = browser.js("[...document.querySelectorAll('figure')].filter((one) => one.getClientRects().length).map((one) => one.querySelector('h2').textContent)")
    for title in titles:
        words = " ".join(title.split())
        failures.expect(title not in shown or any(words in text for text, _, _ in saved), f"{title!r} is not saved")
    failures.expect(all(drawn > 0 and broken == 0 for _, drawn, broken in saved), "a saved chart is empty or no SVG")


def check_search(browser, failures, data):
    """A long table shows the rows that have what is typed, and all of them again; a click on a head sorts them."""
    tables = [panel for panel in chosen_panels(data) if panel["kind"] == "table" and len(panel["rows"]) > 12]
    for number, table in enumerate(tables):
        rows = [row for row in table["rows"] if row]
        words = rows[-1][0]["text"].lower()
        wanted = [row for row in rows if words in [cell["text"].lower() for cell in row]]
        figure = f"document.querySelectorAll('input[type=search]')[{number}].closest('figure')"
        typed = lambda text: browser.js(f"""(() => {{ const box = {figure}.querySelector('input');
            box.value = {json.dumps(text)}; box.dispatchEvent(new Event('input'));
            return [...{figure}.querySelectorAll('tbody tr')].filter((row) => row.getClientRects().length).length; }})()""")
        failures.expect(typed(words) == len(wanted), f"looking for {words!r} does not show its {len(wanted)} rows")
        failures.expect(typed("") == len(rows), f"looking for nothing does not show all rows of {table['title']}")
        column = next((i for i in range(1, len(table["columns"])) if all(isinstance(row[i].get("value"), (int, float)) for row in rows)), None)
        if column is None:
            continue
        sort = lambda: browser.js(f"""(() => {{ const heads = {figure}.querySelectorAll('thead tr:last-child th'); heads[{column}].click();
            return [...{figure}.querySelectorAll('tbody tr')].map((row) => Number(row.children[{column}].dataset.value)); }})()""")
        numbers = sorted(row[column]["value"] for row in rows)
        failures.expect(sort() == numbers, f"{table['title']} is not sorted by a click on a head")
        failures.expect(sort() == numbers[::-1], f"{table['title']} is not sorted the other way by a second click")


def check_opening(browser, failures, data):
    """A click on a row's name opens the view of that name, if there is one."""
    names = [view["name"] for view in data["views"]]
    if len(names) < 2 or not browser.js("document.querySelectorAll('td button').length"):
        return
    name = browser.js("(() => { const all = document.querySelectorAll('td button'), one = all[all.length - 1]; one.click(); return one.textContent; })()")
    shown = browser.js("document.getElementById('view-selector').selectedOptions[0].textContent")
    failures.expect(shown == name, f"a click on {name!r} shows {shown!r}")


def check_selector(browser, failures, data):
    if len(data["views"]) < 2:
        return
    for number in (1, 0):
        browser.js(f"(() => {{ const s = document.getElementById('view-selector'); s.value = '{number}'; s.dispatchEvent(new Event('change')); }})()")
        titles = browser.js("[...document.querySelectorAll('#view h2')].map((one) => one.textContent)")
        wanted = [panel["title"] for panel in data["views"][number]["panels"] if panel["kind"] != "words"]
        failures.expect(all(title in titles for title in wanted), f"view {number} shows {titles}")
        picture = browser.js("document.querySelectorAll('#view canvas, #view svg').length")
        failures.expect(picture > 0, f"view {number} draws nothing")


def numbers_in(json_value):
    if isinstance(json_value, dict):
        for value in json_value.values():
            yield from numbers_in(value)
    elif isinstance(json_value, list):
        for value in json_value:
            yield from numbers_in(value)
    elif isinstance(json_value, (int, float)) and not isinstance(json_value, bool):
        yield json_value


def check_numbers(browser, failures, summary):
    """Every number of a keyed cell stands in summary.json, in the record of its row, or of its first two cells, under its key."""
    cells = browser.js("""[...document.querySelectorAll('td[data-value]')].map((one) =>
        [[...one.parentNode.children].slice(0, 2).map((cell) => cell.textContent), one.dataset.key ?? '', Number(one.dataset.value)])""")

    def holds(record, row, key, value):
        if isinstance(record, dict):
            own = record.get(row[0])
            for one in (own, own.get(row[1]) if isinstance(own, dict) and len(row) > 1 else None):
                if isinstance(one, dict) and key in one and one[key] == value:
                    return True
            return any(holds(other, row, key, value) for other in record.values())
        return isinstance(record, list) and any(holds(other, row, key, value) for other in record)

    keyed = [cell for cell in cells if cell[1]]
    for row, key, value in keyed:
        failures.expect(holds(summary, row, key, value), f"{row}, {key}: {value} is not in summary.json")
    return len(keyed)


def check_numbers_of_intervals(failures, data, summary):
    """Every number that has an interval stands in summary.json too, to seven digits."""
    known = sorted(numbers_in(summary))

    def holds(value):
        if value is None:
            return True
        near = bisect.bisect_left(known, value - 1e-6 * abs(value))
        return near < len(known) and known[near] <= value + 1e-6 * abs(value)

    compared = 0
    for panel in data["panels"] + [panel for view in data["views"] for panel in view["panels"]] + data["last"]:
        if panel["kind"] != "intervals":
            continue
        numbers = [value[0] for series in panel["series"] for value in series["values"]]
        compared += len(numbers)
        missing = [number for number in numbers if not holds(number)]
        failures.expect(not missing, f"{panel['title']}: {missing[:3]} is not in summary.json")
    return compared


def check_data(failures, data, summary, directory):
    """summary.json names a file that holds what the page draws, and its histories are those of the page."""
    if "report_data" in summary:
        told = json.loads((directory / summary["report_data"]).read_text(encoding="utf-8"))
        failures.expect(told == data, f"{summary['report_data']} is not what the page holds")
    histories = [[stay["label"] for stay in band["stays"]] for view in data["views"] for panel in view["panels"]
                 for band in panel.get("histories", [])]
    told = [[stay["mode"] for stay in stays] for tracks in summary.get("histories", {}).values() for stays in tracks.values() if stays]
    failures.expect(sorted(histories) == sorted(told), "the histories are not those of summary.json")


def check_tables(browser, failures, data):
    """Behind each chart there is a table with its numbers."""
    count = browser.js("""[...document.querySelectorAll('.lines details')].map((one) => { one.open = true; return one; }).length""")
    wanted = len(panels_of(data, "lines"))
    failures.expect(count == wanted, f"{count} tables behind {wanted} charts")
    time.sleep(0.2)
    rows = browser.js("[...document.querySelectorAll('.lines details')].map((one) => one.querySelectorAll('tbody tr').length)")
    lengths = [len(panel["x"]) for panel in panels_of(data, "lines")]
    failures.expect(rows == lengths, f"the tables have {rows} rows, not {lengths}")
    browser.js("document.querySelectorAll('details').forEach((one) => { one.open = false; })")


# Texts of pictures that are cut by their picture, lie on another one, or stand twice along an axis; words that tables break, and
# tables that are wider than the paper.
TEXTS = """(() => {
  const found = [], paper = document.documentElement.classList.contains('printing');
  const boxOf = (one) => { const range = document.createRange(); range.selectNodeContents(one); return range.getBoundingClientRect(); };
  for (const picture of document.querySelectorAll('svg.map, svg.heat, svg.intervals, .chart')) {
    const own = picture.getBoundingClientRect(), title = picture.closest('figure').querySelector('h2').textContent;
    if (!own.width) continue;
    const inside = (box, {left, right, top, bottom}) => box.left >= left - 1 && box.right <= right + 1 && box.top >= top - 3 && box.bottom <= bottom + 3;
    const texts = [...picture.querySelectorAll('text, .dygraph-axis-label')].filter((one) => one.textContent.trim()).map((one) => {
      const clip = picture.querySelector('clipPath rect'), at = (name) => Number(clip.getAttribute(name));
      const frame = one.closest('[clip-path]') ? {left: own.left + at('x'), right: own.left + at('x') + at('width'),
        top: own.top + at('y'), bottom: own.top + at('y') + at('height')} : own;
      return {text: one.textContent, box: one.matches('text') ? one.getBoundingClientRect() : boxOf(one), frame,
        slanted: (one.getAttribute('transform') ?? '').includes('rotate')};
    });
    for (const {text, box, frame} of texts) if (!inside(box, frame)) found.push(`${title}: ${text} is cut`);
    for (const [i, a] of texts.entries())
      for (const b of texts.slice(i + 1))
        if (!a.slanted && !b.slanted && a.box.left < b.box.right && b.box.left < a.box.right && a.box.top + 3 < b.box.bottom - 3 && b.box.top + 3 < a.box.bottom - 3)
          found.push(`${title}: ${a.text} lies on ${b.text}`);
    const numbers = [...picture.querySelectorAll('.dygraph-axis-label-y')].map((one) => one.textContent).filter((text) => text);
    if (new Set(numbers).size < numbers.length) found.push(`${title}: a number stands twice along y`);
  }
  for (const one of document.querySelectorAll('.scroll td, .scroll th')) {
    if (!/[\\s-]/.test(one.textContent.trim()) && boxOf(one).height > 2.2 * parseFloat(getComputedStyle(one).fontSize))
      found.push(`${one.textContent} is broken in a table`);
  }
  if (document.querySelectorAll('clipPath').length > new Set([...document.querySelectorAll('clipPath')].map((one) => one.id)).size) found.push('two maps share a clip');
  for (const one of document.querySelectorAll('.scroll'))
    if (paper && one.scrollWidth > one.clientWidth + 1) found.push(`${one.closest('figure').querySelector('h2').textContent}: is cut on paper`);
  return found;
})()"""


def check_texts(browser, failures):
    """No text of a picture is cut or lies on another one, on a telephone, a tablet, two screens and on A4; the width is used."""
    def expect_none(where):
        end = time.monotonic() + 4  # it is drawn again soon
        while browser.js(TEXTS) and time.monotonic() < end:
            time.sleep(0.2)
        for found in browser.js(TEXTS):
            failures.expect(False, f"{where}: {found}")

    for width in (400, 800, 1280, 1920):
        browser.size(width, 900)
        time.sleep(0.2)
        expect_none(f"at {width} pixels")
        used, needed = browser.js("[document.querySelector('main').clientWidth, document.documentElement.scrollWidth]")
        failures.expect(0.95 * width <= used and needed <= width, f"of {width} pixels the page uses {used}, and it needs {needed}")
    browser.call("Emulation.setEmulatedMedia", media="print")
    browser.size(703, 1000)
    browser.js("dispatchEvent(new Event('beforeprint'))")
    expect_none("on paper")
    browser.js("dispatchEvent(new Event('afterprint'))")
    browser.call("Emulation.setEmulatedMedia", media="")


def shoot(browser, prefix):
    for width in (400, 1280):
        for theme in ("light", "dark"):
            browser.size(width, 900)
            browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": theme}])
            time.sleep(0.5)
            browser.js("scrollTo(0, 0)")
            height = browser.js("document.documentElement.scrollHeight")
            clip = {"x": 0, "y": 0, "width": width, "height": height, "scale": 1}
            picture = browser.call("Page.captureScreenshot", captureBeyondViewport=True, clip=clip)
            pathlib.Path(f"{prefix}_{width}_{theme}.png").write_bytes(base64.b64decode(picture["data"]))


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("page")
    arguments.add_argument("summary", nargs="?")
    arguments.add_argument("--shots")
    options = arguments.parse_args()
    if BROWSER is None or websocket is None:
        print("needs chromium and python3-websocket")
        return SKIPPED
    text = pathlib.Path(options.page).read_text(encoding="utf-8")
    data = json.loads(text.split('<script type="application/json" id="data">')[1].split("</script>")[0])
    browser = Browser(options.page)
    failures = Failures()
    try:
        check_drawing(browser, failures, data)
        if data["views"] and any(panel["kind"] == "lines" for panel in data["views"][0]["panels"]):
            check_zoom(browser, failures)
            check_legend(browser, failures, data)
        if panels_of(data, "lines"):
            check_hover(browser, failures, data)
            check_tables(browser, failures, data)
        check_selector(browser, failures, data)
        check_intervals(browser, failures, data)
        check_heat(browser, failures, data)
        check_search(browser, failures, data)
        check_saving(browser, failures, data)
        check_opening(browser, failures, data)
        if options.summary:
            path = pathlib.Path(options.summary)
            summary = json.loads(path.read_text(encoding="utf-8"))
            compared = check_numbers(browser, failures, summary) + check_numbers_of_intervals(failures, data, summary)
            failures.expect(compared > 0, "nothing in the page is a number of the summary")
            check_data(failures, data, summary, path.parent)
        check_texts(browser, failures)
        if options.shots:
            shoot(browser, options.shots)
    finally:
        browser.close()
    for failure in failures.all + browser.complaints:
        print(failure)
    return 1 if failures.all or browser.complaints else 0


if __name__ == "__main__":
    sys.exit(main())
