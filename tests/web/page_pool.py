"""Pages that are used again: what a new one costs a browser is most of what most tests cost."""

from collections import defaultdict
from typing import Any

PATIENCE = 120_000
"""Milliseconds that a page waits, unless the test says otherwise: a software driver may compile a shader for long."""


class PagePool:
    """Pages of a browser that nobody uses now, by the options of their contexts.

    Who takes a page finds it as new: blank, light, with an empty cache, without cookies and without errors. Only a
    page that is kept shows what it showed: one that draws what it is told, whatever it drew before.
    """

    def __init__(self, browser: Any) -> None:
        self._browser = browser
        self._idle: dict[str, list[Any]] = defaultdict(list)

    def take(self, size: tuple[int, int], options: dict[str, Any], address: str = "") -> Any:
        """Page of a size; ``page.errors`` is the list of the errors of its scripts. `address` is that of a page."""
        key = repr((address, sorted(options.items())))
        page = self._idle[key].pop() if self._idle[key] else self._new(key, address, options)
        page.set_viewport_size({"width": size[0], "height": size[1]})
        page.set_default_timeout(PATIENCE)
        page.emulate_media(color_scheme="light")
        page.context.clear_cookies()
        if not address:
            page.session.send("Network.clearBrowserCache")
        return page

    def give_back(self, page: Any) -> None:
        """End what runs in a page, and keep it for another test."""
        if not page.is_closed():
            if not page.kept:
                page.goto("about:blank")
            page.errors = []
            self._idle[page.key].append(page)

    def _new(self, key: str, address: str, options: dict[str, Any]) -> Any:
        context = self._browser.new_context(device_scale_factor=1, **options)
        page = context.new_page()
        page.key, page.kept, page.errors = key, bool(address), []
        page.session = context.new_cdp_session(page)
        page.on("pageerror", lambda error: page.errors.append(str(error)))
        page.on("console", lambda message: page.errors.append(message.text) if message.type == "error" else None)
        if address:
            page.goto(address)
        return page
