"""After warming up nothing is left to compile."""

import numpy as np
from numba.core.registry import CPUDispatcher

from lad import fused, inverse
from lad.hyperparameters import LADParameters
from lad.lad_assistant import LADAssistant
from lad.warm_up import warm_up


def signatures():
    """Count the compiled versions of every entry point."""
    return {
        f"{module.__name__}.{name}": len(value.signatures)
        for module in (fused, inverse)
        for name, value in vars(module).items()
        if isinstance(value, CPUDispatcher)
    }


def test_one_version_of_each_function_serves_for_ever():
    """Training, predicting, repairing, whatever arrays people hand in: no second version."""
    warm_up()
    before = signatures()
    entries = ("fused.predict", "fused.learn", "fused.likeliest_wrong", "inverse.invert")
    assert all(before[f"lad.{name}"] == 1 for name in entries)
    rng = np.random.default_rng(0)
    model = LADAssistant(LADParameters(capacity=20))
    inputs = rng.normal(size=(60, 19))
    inputs.flags.writeable = False
    for step, x in enumerate(inputs):
        model.assist(x if step % 2 else x[::-1].astype(np.float32))
        model.learn(helping=True, command=(0.1, np.float64(0.2)))
    model.how.repair()
    again = LADAssistant.from_bytes(model.to_bytes())
    again.assist(inputs[0])
    again.learn(helping=False, command=None)
    assert signatures() == before
