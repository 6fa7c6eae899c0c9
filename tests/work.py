"""Work that other processes find by its name."""

import os
import signal
import time

from vexture.workers import WORTH


def slow(shared, item):
    """Work of which one piece is enough for other processes to be started."""
    if os.getpid() == shared[0] and item == 0:
        time.sleep(WORTH / 8)
    return os.getpid(), shared[1] ** item


def dies(shared, item):
    """Work whose piece 3 kills its worker once, or each time."""
    mark, again = shared
    if item == 0:
        time.sleep(WORTH / 8)
    if item == 3 and (again or not mark.exists()):
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return item * item
