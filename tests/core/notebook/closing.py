"""Fixtures of all tests of a module that imports them: none leaves a widget behind."""

import asyncio
import threading

import pytest


@pytest.fixture(autouse=True)
def none_is_left():
    ipywidgets = pytest.importorskip("ipywidgets")

    yield
    for thread in threading.enumerate():
        if thread.name == "vexture map":
            thread.join(30)  # else it may arrive while its widget is being closed
    ipywidgets.Widget.close_all()


@pytest.fixture(autouse=True)
def no_loop_of_a_browser():
    """A browser that an earlier test of this process has opened holds a loop, which never goes on here."""
    loop = asyncio._get_running_loop()
    asyncio._set_running_loop(None)
    yield
    asyncio._set_running_loop(loop)
