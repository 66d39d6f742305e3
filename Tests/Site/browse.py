# SPDX-License-Identifier: MIT
# Opens the site from the disk, as somebody who has been given the folder; looks at it at two sizes, and looks something up.
# usage: browse.py SITE_FOLDER PICTURES_FOLDER
import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Web"))
from chromium import Browser  # noqa: E402

site, pictures = (os.path.abspath(path) for path in sys.argv[1:])
folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
browser = Browser(folder.name, f"file://{site}/", pictures)
failures = []
loaded = "document.readyState === 'complete' && location.protocol === 'file:'"


def expect(holds, what):
    print(("ok     " if holds else "FAILED ") + what)
    if not holds:
        failures.append(what)


def visit(place):
    browser.call("Page.navigate", url=f"file://{site}/{place}")
    browser.wait(f"{loaded} && location.pathname.endsWith('{place}')", place)


try:
    for place in ("index.html", "mixer.html", "decisions/0071-the-page.html"):
        visit(place)
        for name, width, height in (("desk", 1280, 800), ("phone", 390, 844)):
            browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
            expect(browser.value("document.documentElement.scrollWidth <= innerWidth"), f"{place} fits a {name}")
            expect(browser.value("[...document.images].every(image => image.complete && image.naturalWidth > 0)"), f"{place}: every picture is there")
            browser.picture(f"site-{os.path.basename(place)[:-5]}-{name}.png", width, height, 1)
    visit("mixer.html")
    browser.value("document.getElementById('list').click()")
    expect(browser.value("getComputedStyle(document.getElementById('pages')).display") == "block", "a phone's list of pages opens")
    browser.picture("site-list-phone.png", 390, 844, 1)
    browser.call("Emulation.setDeviceMetricsOverride", width=1280, height=800, deviceScaleFactor=1, mobile=False)
    browser.value("(box => { box.focus(); box.value = 'limiter ceiling'; box.dispatchEvent(new Event('input')); })(document.getElementById('search'))")
    browser.wait("document.querySelectorAll('#found a').length > 2", "something found")
    browser.picture("site-search.png", 1280, 800, 1)
    browser.value("document.querySelector('#found a').click()")
    browser.wait(f"{loaded} && location.hash.length > 1 && !!document.getElementById(decodeURIComponent(location.hash.slice(1)))", "the part that was found")
    expect(not browser.complaints, f"no complaint of the browser {browser.complaints[:3] or ''}")
finally:
    browser.process.kill()
sys.exit("FAILED: " + ", ".join(failures) if failures else 0)
