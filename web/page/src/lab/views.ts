// The part of the page with the laboratory and the view of collisions.
export { collisionView } from "./collision.js";
export { laboratory } from "./view.js";
