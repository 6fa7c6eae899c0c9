"""Files of a flood's page, which `make viewer` builds."""

from typing import Final

from vexture.pages.page import Bundle

FLOOD: Final = Bundle("flood.js", "flood.css", __package__)
