"""The examples in the docstrings of the model of GPUs."""

import doctest

import gpu_cost


def test_examples_in_the_docstrings():
    found = doctest.testmod(gpu_cost)
    assert found.attempted
    assert not found.failed
