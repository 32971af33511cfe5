"""The end of a message: what is allowed."""

from protocols.files.suggestion import allowed, listed


def test_a_near_miss_is_guessed_and_a_far_one_is_not():
    """Only a similar name is offered as a guess."""
    assert allowed("limted", ["limited"]).endswith("(did you mean 'limited'?)")
    assert allowed("xyz", ["limited"]) == "allowed: limited"
    assert allowed("xyz", []) == "allowed: nothing"
    assert allowed("nofile", ["limited"], ["a file"]) == "allowed: a file, limited"


def test_long_lists_are_shortened():
    """Up to twelve names are all shown; more are summed up."""
    assert listed([str(n) for n in range(12)]).endswith("10, 11")
    assert listed([str(n) for n in range(13)]) == "allowed: 0, 1, 2, ..., 12 (13 in all)"
    assert listed([]) == "allowed: nothing"
