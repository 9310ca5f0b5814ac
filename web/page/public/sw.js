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
async function fromNetwork(request) {
  const response = await fetch(request);
  if (response.ok) await (await caches.open(KEPT)).put(request, response.clone());
  return response;
}
self.addEventListener("fetch", (event) => {
  const { request } = event;
  if (request.method !== "GET" || new URL(request.url).origin !== location.origin) return;
  const fresh = fromNetwork(request);
  const kept = caches.open(KEPT).then((cache) => cache.match(request));
  event.respondWith(kept.then((response) => response ?? fresh));
  event.waitUntil(
    fresh.then(
      () => undefined,
      () => undefined,
    ),
  );
});
