"""Closed chains whose fits are known."""

import numpy as np

from vexture.bezier.fit_closed import fit_closed, fit_samples, smooth_chain


def test_samples_of_a_circle_give_four_cubics() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 100, endpoint=False)
    circle = np.column_stack((np.cos(angle), np.sin(angle)))
    assert len(fit_samples(circle, np.zeros(100, np.bool_), 1e-3)) == 4


def test_a_disc_of_stairs_becomes_round() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False)
    disc = np.round(20.0 * np.column_stack((np.cos(angle), np.sin(angle))))
    cubics = fit_closed(disc, 0.5)
    assert len(cubics) < 9
    assert np.abs(np.hypot(*cubics[:, 0].T) - 20.0).max() < 0.4


def test_smoothing_moves_no_sample_farther_than_allowed() -> None:
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    even = smooth_chain(square, np.zeros(4, np.bool_), np.full(4, 10.0), np.full(4, 0.1))
    assert (np.hypot(*(even - square).T) <= 0.1 + 1e-12).all()
