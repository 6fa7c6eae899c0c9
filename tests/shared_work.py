"""Work that other processes find by its name."""

import os
import signal
import time

from vexture.base.workers import WORTH


def slow_power(shared, item):
    """Return the process and a power; one piece takes long enough for other processes to start."""
    if os.getpid() == shared[0] and item == 0:
        time.sleep(WORTH / 8)
    return os.getpid(), shared[1] ** item


def kill_worker(shared, item):
    """Return a square; piece 3 kills its worker once, or each time."""
    mark, again = shared
    if item == 0:
        time.sleep(WORTH / 8)
    if item == 3 and (again or not mark.exists()):
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return item * item


def forget_once(mark, item):
    """Return a square; the scheduler of a cluster forgets piece 3 once, while it is computed."""
    if item == 3 and not mark.exists():
        from distributed import get_client, get_worker

        mark.touch()
        key = get_worker().get_current_task()
        get_client().run_on_scheduler(cancel_task, key=key)
        time.sleep(1.0)  # its client learns that it is forgotten before it is done
    return item * item


def cancel_task(dask_scheduler, key):
    """Let a scheduler report to all clients that wait for a piece of work that it is cancelled."""
    for client in {each.client_key for each in dask_scheduler.tasks[key].who_wants}:
        dask_scheduler.report({"op": "cancelled-keys", "keys": [key], "reason": "already forgotten"}, client=client)


def fail_late(shared, item):
    """Return the piece after a while; one piece fails as a disk does."""
    time.sleep(0.3)
    if item == shared:
        raise FileNotFoundError(2, "No such file", "lost.nc")
    return item
