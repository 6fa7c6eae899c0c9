/** The page of `vexture flood`. */
