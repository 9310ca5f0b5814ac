// The page without a network, and with one that does not answer: this worker answers with what it
// keeps, and asks the network for the next time. What it does not keep comes from the network.
const KEPT = "carom-explorer";
self.addEventListener("install", (event) => {
  event.waitUntil(
    caches.open(KEPT).then((cache) => cache.addAll(["./", "manifest.webmanifest", "icon.svg"])),
  );
  self.skipWaiting();
});
self.addEventListener("activate", (event) => event.waitUntil(self.clients.claim()));
/** What the network answers; the worker keeps it. */
async function fetched(request) {
  const response = await fetch(request);
  if (response.ok) await (await caches.open(KEPT)).put(request, response.clone());
  return response;
}
/** What the worker has, or else what the network answers. */
async function answer(request, fresh) {
  const cache = await caches.open(KEPT);
  return (await cache.match(request)) ?? fresh;
}
self.addEventListener("fetch", (event) => {
  const { request } = event;
  if (request.method !== "GET" || new URL(request.url).origin !== location.origin) return;
  const fresh = fetched(request);
  event.respondWith(answer(request, fresh));
  // Without a network, what the worker has is the answer.
  event.waitUntil(fresh.catch(() => undefined));
});
