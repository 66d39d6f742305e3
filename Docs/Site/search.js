// SPDX-License-Identifier: MIT
// Search without a server: the words of all pages are a script of their own, taken from beside this one when somebody begins to type.
const root = document.currentScript.dataset.root;
const box = document.getElementById("search"), found = document.getElementById("found");
const list = document.getElementById("list"), pages = document.getElementById("pages");
let words; // [title, address, text] of each part
let taking;

function takeWords() {
    taking ??= new Promise(done => {
        const script = document.createElement("script");
        script.src = root + "/words.js";
        script.onload = done;
        document.head.append(script);
    });
    return taking;
}

// "plugin" finds "plug-in".
const folded = text => text.toLowerCase().replaceAll("-", "");

// Every word must be there; a title counts more than a mention.
function scoreOf(part, wanted) {
    const title = folded(part[0]), text = folded(part[2]);
    let score = 0;
    for (const word of wanted) {
        const times = text.split(word).length - 1;
        if (!title.includes(word) && times === 0) return 0;
        score += (title.includes(word) ? 20 : 0) + Math.min(times, 5);
    }
    return /^(changelog|decisions)/.test(part[1]) ? score / 4 : score; // what was, and why: behind what is
}

function excerpt(text, word) {
    const at = Math.max(0, text.toLowerCase().indexOf(word) - 60);
    return (at > 0 ? "… " : "") + text.slice(at, at + 180) + (at + 180 < text.length ? " …" : "");
}

function row(part, word) {
    const link = document.createElement("a"), text = document.createElement("span");
    link.href = root + "/" + part[1];
    link.textContent = part[0];
    text.textContent = excerpt(part[2], word);
    link.append(text);
    return link;
}

async function search() {
    const wanted = folded(box.value).split(/\s+/).filter(word => word);
    found.hidden = wanted.length === 0;
    if (found.hidden) return;
    await takeWords();
    const hits = words.map(part => [scoreOf(part, wanted), part]).filter(hit => hit[0] > 0).sort((a, b) => b[0] - a[0]);
    found.replaceChildren(...hits.slice(0, 20).map(hit => row(hit[1], wanted[0])));
    if (hits.length === 0) found.textContent = "Nothing of that is on any page.";
}

box.addEventListener("input", search);
box.addEventListener("focus", takeWords, { once: true });
document.addEventListener("keydown", event => {
    if (event.key === "Escape") { box.value = ""; search(); }
    if (event.key === "Enter" && event.target === box) found.querySelector("a")?.click();
    if (event.key === "/" && event.target !== box) { event.preventDefault(); box.focus(); }
});
found.addEventListener("click", () => { found.hidden = true; });
list.addEventListener("click", () => list.setAttribute("aria-expanded", String(pages.classList.toggle("open"))));
