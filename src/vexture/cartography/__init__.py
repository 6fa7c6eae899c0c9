"""Maps of geographic features: their place on a plane, their colours, and the texture of all of them."""
