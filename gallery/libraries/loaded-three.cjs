// Stands for three.js in the libraries that a page loads after it.
module.exports = globalThis.galleryModules.three;
