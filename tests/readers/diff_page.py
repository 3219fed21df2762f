"""Opens the page of a difference in headless Chromium and uses it as a reviewer does.

Arguments: the page, a folder for screenshots. Needs `chromium` and `chromedriver` on the path;
where they are not and this is a Debian system on which we are root, they are installed.
"""

import os
import pathlib
import shutil
import subprocess
import sys

from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

page = pathlib.Path(sys.argv[1]).resolve()
shots = pathlib.Path(sys.argv[2])


def browser_and_driver():
    find = lambda: (
        shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome"),
        shutil.which("chromedriver"),
    )
    if not all(find()) and shutil.which("apt-get") and os.geteuid() == 0:
        quiet = {"env": os.environ | {"DEBIAN_FRONTEND": "noninteractive"}, "check": False,
                 "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        install = ["apt-get", "install", "--yes", "--no-install-recommends", "chromium",
                   "chromium-driver", "fonts-dejavu-core"]
        if subprocess.run(install, **quiet).returncode != 0:
            subprocess.run(["apt-get", "update"], **quiet)
            subprocess.run(install, **quiet)
    if not all(find()):
        sys.exit("the page of `egg diff` is tested in a browser: install Chromium and its driver "
                 "(on Debian: apt-get install chromium chromium-driver)")
    return find()


chromium, driver_path = browser_and_driver()
options = webdriver.ChromeOptions()
options.binary_location = chromium
for argument in ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--window-size=1500,950"]:
    options.add_argument(argument)
options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
driver = webdriver.Chrome(options=options, service=webdriver.ChromeService(driver_path))
try:
    driver.get(page.as_uri())
    rows = driver.find_elements(By.CSS_SELECTOR, "#changes tbody tr")
    shapes = driver.find_elements(By.CSS_SELECTOR, "#drawings svg [data-part]")
    assert rows and shapes, (len(rows), len(shapes))
    driver.save_screenshot(str(shots / "page.png"))
    part_of = lambda element: element.get_attribute("data-part")
    on = lambda css: [part_of(e) for e in driver.find_elements(By.CSS_SELECTOR, css + ".on")]

    # A row marks all shapes of its part, and nothing else.
    drawn = {part_of(shape) for shape in shapes}
    row = next(row for row in rows if part_of(row) in drawn)
    row.click()
    marked = on("#drawings [data-part]")
    assert marked and set(marked) == {part_of(row)}, (part_of(row), marked)
    assert len(marked) == sum(part_of(shape) == part_of(row) for shape in shapes)
    assert "on" in row.get_attribute("class").split()
    driver.save_screenshot(str(shots / "row.png"))

    # A shape marks its row, which comes into sight.
    listed = [part_of(row) for row in rows]
    shape = next(s for s in reversed(shapes)
                 if part_of(s) in listed and part_of(s) != part_of(row) and s.is_displayed()
                 and "after" in (s.get_attribute("class") or ""))
    driver.execute_script(
        "arguments[0].dispatchEvent(new MouseEvent('click', {bubbles: true}))", shape)
    assert set(on("#changes tr")) == {part_of(shape)}, (part_of(shape), on("#changes tr"))
    found = next(r for r in rows if part_of(r) == part_of(shape))
    seen = driver.execute_script(
        "const a = arguments[0].getBoundingClientRect(), b = document.getElementById('list')"
        ".getBoundingClientRect(); return a.top >= b.top - 1 && a.bottom <= b.bottom + 1", found)
    assert seen, "the marked row is out of sight"
    driver.save_screenshot(str(shots / "shape.png"))

    # Keys go through the rows, and Escape marks nothing.
    body = driver.find_element(By.TAG_NAME, "body")
    body.send_keys(Keys.ESCAPE)
    assert not on("#changes tr") and not on("#drawings [data-part]")
    body.send_keys("j")
    assert on("#changes tr")[0] == listed[0]
    later = next((part for part in listed if part != listed[0]), listed[0])
    for _ in range(len(listed)):
        if on("#changes tr")[0] == later:
            break
        body.send_keys("j")
    assert on("#changes tr")[0] == later, (on("#changes tr"), later)
    body.send_keys(Keys.ESCAPE)
    body.send_keys("k")
    assert on("#changes tr")[-1] == listed[-1]
    body.send_keys(Keys.ESCAPE)

    # The filter hides and shows the rows of each class.
    boxes = driver.find_elements(By.CSS_SELECTOR, "#filter input")
    assert boxes
    shown = lambda name: [r for r in driver.find_elements(By.CSS_SELECTOR, "#changes tr." + name)
                          if r.is_displayed()]
    for box in boxes:
        name = box.get_attribute("value")
        before = len(shown(name))
        assert before > 0
        others = len([r for r in rows if r.is_displayed()]) - before
        box.click()
        assert not shown(name)
        assert len([r for r in rows if r.is_displayed()]) == others
        driver.save_screenshot(str(shots / f"without-{name}.png"))
        box.click()
        assert len(shown(name)) == before

    # Nothing was asked of the network, nothing was said on the console.
    said = [entry for entry in driver.get_log("browser")]
    assert not said, said
    asked = [entry["message"] for entry in driver.get_log("performance")
             if '"Network.requestWillBeSent"' in entry["message"]]
    asked = [entry for entry in asked if '"url":"http' in entry]
    assert not asked, asked
    print("ok", len(rows), "rows,", len(shapes), "shapes")
finally:
    driver.quit()
