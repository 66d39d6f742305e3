# SPDX-License-Identifier: GPL-3.0-or-later
# A scene that was drawn in the mixer, opened in the page, shared, and opened by its link in another browser: the same samples in both, and
# those of physvib. LINK is one that the mixer made of the same scene. usage: opened-in-the-page.py SCENE.json FOLDER_OF_THE_PAGE PHYSVIB PICTURES_FOLDER SECONDS [LINK]
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../Web"))
from chromium import Browser
from served import expect, failures, hash_in_page, hash_of, samples_of, serve

scene, page, physvib, pictures = (os.path.abspath(path) for path in sys.argv[1:5])
seconds = int(sys.argv[5])
server = serve(page)
origin = f"http://127.0.0.1:{server.server_port}/"
work = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
wanted = "(await import('./page.js')).wanted()"
browsers = [Browser(tempfile.mkdtemp(dir=work.name), origin, pictures, ()) for _ in range(2)]


def visit(browser, url):
    browser.call("Page.navigate", url=url)
    browser.wait("document.getElementById('start')?.disabled === false", url)


try:
    one, other = browsers
    visit(one, origin)
    text = open(scene).read()
    one.value(f"(transfer => {{ transfer.items.add(new File([{json.dumps(text)}], 'drawn.json')); const file = document.getElementById('file'); file.files = transfer.files; file.dispatchEvent(new Event('change')); }})(new DataTransfer()); 0")
    one.wait("document.title.startsWith('drawn')", "the scene in the page")
    one.picture("8-page.png", 1280, 800, 1)
    one.click("#sharing")
    one.wait("document.getElementById('share').open", "a link")
    link = one.value("document.getElementById('link').value")
    visit(other, link)
    other.picture("9-link.png", 1280, 800, 1)
    here, there = hash_in_page(one, wanted, seconds), hash_in_page(other, wanted, seconds)
    expect(here == there, f"a link of {len(link)} characters gives the same {seconds} s: {here[:16]}, {there[:16]}")
    if len(sys.argv) > 6:
        made = sys.argv[6].split("#", 1)[1]
        other.call("Page.navigate", url="about:blank") # or the same page only gets another fragment
        visit(other, origin + "#" + made)
        mixers = hash_in_page(other, wanted, seconds)
        expect(mixers == here, f"the mixer's link, {len(made)} characters behind the #, gives them too: {mixers[:16]}")
    native = os.path.join(work.name, "native.wav")
    subprocess.run([physvib, "render", scene, "--seconds", str(seconds), "--instructions", "scalar", "--out", native], check=True, stdout=subprocess.DEVNULL)
    expect(len(samples_of(native)) > 0 and hash_of(native) == here, f"and physvib render the same as the page: {hash_of(native)[:16]}")
    for browser in browsers:
        expect(not browser.complaints, "no complaint on the console " + "; ".join(browser.complaints))
finally:
    for browser in browsers:
        browser.end()
sys.exit(f"{len(failures)} failed" if failures else 0)
