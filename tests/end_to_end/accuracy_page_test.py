#!/usr/bin/python3
"""The page of vellus_accuracy in a browser: a tiny real run, then clicks through axes and points at two widths.

accuracy_page_test.py PROGRAM [--page FILE.html] [--shots DIR]   (exit status 77: no browser here, or none that can be driven)
"""
import argparse
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile

BROWSER = "/usr/bin/chromium"
DRIVER = "/usr/bin/chromedriver"
SKIPPED = 77

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
except ImportError:
    sys.exit(SKIPPED)


def make_page(program, folder):
    """Two grooms on two axes, and one whole frame: as small as a run can be."""
    common = ["--out", str(folder), "--quick", "--size", "48", "--frames", "2", "--warmup", "2", "--spp", "4",
              "--strands", "300", "--colours", "brown,white"]
    subprocess.run([program, *common, "--lights", "front,environment", "--axes", "opacity,shadow,scattering"], check=True)
    return folder / "accuracy.html"


def open_browser(profile, width):
    options = Options()
    options.binary_location = BROWSER
    for flag in ("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
                 "--disable-background-networking", "--disable-component-update", "--disable-sync",
                 "--force-device-scale-factor=1", "--hide-scrollbars", f"--user-data-dir={profile}", f"--window-size={width},1000"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"performance": "ALL", "browser": "ALL"})
    browser = webdriver.Chrome(service=Service(DRIVER), options=options)
    # A window is never as narrow as a phone; what it shows is.
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": False})
    return browser


def check(condition, what):
    if not condition:
        raise AssertionError(what)


def check_width(browser, where):
    shown, needed = browser.execute_script(
        "return [document.documentElement.clientWidth, document.documentElement.scrollWidth]")
    check(needed <= shown, f"{where}: the page needs {needed} pixels, {shown} are there")
    spilling = browser.execute_script("""
        return [...document.querySelectorAll("body *")].filter((e) => !e.closest(".scroll") && !e.closest("svg") &&
            e.getBoundingClientRect().right > innerWidth + 1).map((e) => e.outerHTML.slice(0, 80))""")
    check(not spilling, f"{where}: beyond the right edge: {spilling}")
    outside = browser.execute_script("""
        const box = document.querySelector("#chart svg").getBoundingClientRect();
        return [...document.querySelectorAll("#chart svg text, #chart .mark")].filter((e) => {
            const b = e.getBoundingClientRect(); return b.left < box.left - 1 || b.right > box.right + 1; }).map((e) => e.outerHTML)""")
    check(not outside, f"{where}: outside the chart: {outside}")


def check_pictures(browser, where):
    sizes = browser.execute_script("""
        return Promise.all([...document.querySelectorAll("#detail img")].map(async (i) => {
            await i.decode().catch(() => {}); return [i.naturalWidth, i.getBoundingClientRect().width]; }))""")
    check(len(sizes) == 3, f"{where}: {len(sizes)} pictures instead of three")
    for natural, shown in sizes:
        check(natural > 0 and shown > 50, f"{where}: a picture is {natural} pixels wide and takes {shown}")


def check_table(browser, where):
    """Errors rise after a click on their title, and fall after another."""
    def errors():
        cells = browser.find_elements(By.CSS_SELECTOR, "#table tbody td:nth-child(2)")
        return [float(cell.text.split()[0]) for cell in cells]
    for down in (False, True):
        browser.execute_script("document.querySelectorAll('#table th button')[1].click()")
        found = errors()
        check(found == sorted(found, reverse=down), f"{where}: the table is not sorted: {found}")


def check_axis(browser, axis, where):
    browser.find_element(By.CSS_SELECTOR, f"#axes [data-axis={axis}]").click()
    names = [p.get_attribute("data-name") for p in browser.find_elements(By.CSS_SELECTOR, "#chart .point")]
    check(len(names) > 1, f"{where}: {len(names)} points")
    check(browser.find_elements(By.CSS_SELECTOR, "#chart .point.front"), f"{where}: no Pareto front")
    for name in names:
        browser.execute_script("""
            document.querySelector(`#chart .point[data-name="${arguments[0]}"]`).dispatchEvent(new MouseEvent("click", {bubbles: true}))""", name)
        check(browser.find_element(By.CSS_SELECTOR, "#detail h2").text == name, f"{where}: {name} is not shown")
        check_pictures(browser, f"{where} {name}")
        check_width(browser, f"{where} {name}")
    check_table(browser, where)


def check_requests(browser):
    """Nothing but the page itself and what it carries was asked for."""
    for entry in browser.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] not in ("Network.requestWillBeSent", "Network.webSocketCreated"):
            continue
        # The browser's own empty tab may still be loading.
        if message["params"].get("documentURL", "").startswith("chrome://"):
            continue
        url = message["params"].get("request", message["params"])["url"]
        check(url.startswith(("file://", "data:")), f"the page asked for {url}")
    complaints = [e["message"] for e in browser.get_log("browser") if e["level"] == "SEVERE"]
    check(not complaints, f"the browser complains: {complaints}")


def check_page(page, width, shots):
    profile = tempfile.mkdtemp(prefix="vellus_page_")
    browser = open_browser(profile, width)
    try:
        browser.get_log("performance")  # of the empty tab it begins with
        browser.get(page.resolve().as_uri())
        tabs = [tab.get_attribute("data-axis") for tab in browser.find_elements(By.CSS_SELECTOR, "#axes button")]
        check(tabs, "there are no axes")
        for axis in tabs:
            check_axis(browser, axis, f"{width} px, {axis}")
            if shots:
                height = browser.execute_script("return document.documentElement.scrollHeight")
                browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
                    "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
                browser.save_screenshot(str(pathlib.Path(shots) / f"{axis}_{width}.png"))
        check_requests(browser)
    finally:
        browser.quit()
        shutil.rmtree(profile, ignore_errors=True)


def knows_localhost():
    try:
        return bool(socket.getaddrinfo("localhost", None))
    except socket.gaierror:
        return False


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--shots")
    arguments = parser.parse_args()
    if not (os.path.exists(BROWSER) and os.path.exists(DRIVER)):
        sys.exit(SKIPPED)
    if not knows_localhost():
        print("skipped: no address for localhost, by which the browser's driver goes: echo 127.0.0.1 localhost >> /etc/hosts")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="vellus_accuracy_") as folder:
        page = arguments.page or make_page(arguments.program, pathlib.Path(folder))
        for width in (1280, 400):
            check_page(page, width, arguments.shots)


main()
