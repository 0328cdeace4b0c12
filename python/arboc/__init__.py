"""Specialised dynamics of a robot, compiled from its model.

    import arboc
    ur5 = arboc.compile("ur5.urdf", functions=["rnea", "crba"])
    tau = ur5.rnea(q, v, a)        # one state, shapes (6,); or many, shapes (N, 6)

`help(ur5.rnea)` says what goes in and comes out, with shapes and units.
"""

from arboc._compile import CompileError, compile, find_arboc
from arboc._model import Model

__all__ = ["CompileError", "Model", "compile", "find_arboc"]
