// What stands for the typesetter in bundles of pages, where texts are set in a worker. It imports nothing: what a module
// that is loaded later shares with others would become a file of its own.

/** There is none. @type {any} */
export const Typesetter = null;
