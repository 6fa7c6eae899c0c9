"""Work that other processes find by its name."""

import os
import signal
import time

from vexture.base.workers import WORTH


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


def is_forgotten(mark, item):
    """Work whose piece 3 the scheduler of a cluster forgets once, while it is done."""
    if item == 3 and not mark.exists():
        from distributed import get_client, get_worker

        mark.touch()
        key = get_worker().get_current_task()
        get_client().run_on_scheduler(forget, key=key)
        time.sleep(1.0)  # who waits for it hears that it is forgotten before it is done
    return item * item


def forget(dask_scheduler, key):
    """Let a scheduler tell all who wait for a piece of work that it is cancelled."""
    for client in {each.client_key for each in dask_scheduler.tasks[key].who_wants}:
        dask_scheduler.report({"op": "cancelled-keys", "keys": [key], "reason": "already forgotten"}, client=client)


def waits(shared, item):
    """Work that takes a while, of which a piece fails as a disk does."""
    time.sleep(0.3)
    if item == shared:
        raise FileNotFoundError(2, "No such file", "lost.nc")
    return item
