// SPDX-License-Identifier: MIT
// Service worker: makes the page work offline after the first visit. build-web.sh inserts the list of files and the version.
const version = 'physvib-@VERSION@', files = ['@FILES@'];

self.addEventListener('install', event => event.waitUntil(caches.open(version).then(kept => kept.addAll(files.map(file => new Request(file, { cache: 'reload' }))))));
self.addEventListener('activate', event => event.waitUntil(caches.keys()
    .then(names => Promise.all(names.filter(name => name.startsWith('physvib-') && name !== version).map(name => caches.delete(name)))).then(() => self.clients.claim())));
self.addEventListener('fetch', event => {
    if (event.request.method !== 'GET' || new URL(event.request.url).origin !== location.origin) return;
    event.respondWith(caches.open(version).then(kept => kept.match(event.request, { ignoreSearch: true })).then(found => found ?? fetch(event.request)));
});
