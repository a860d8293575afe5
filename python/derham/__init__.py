"""Discrete exterior calculus: simplicial complexes with exact boundary operators and Hodge stars, on numpy and scipy.

>>> import derham
>>> K = derham.generate.box(3, 4)
>>> K.sizes
(125, 604, 864, 384)
>>> bool((K.d(1) @ K.d(0)).count_nonzero())
False
"""

from . import errors  # first: the compiled half raises them
from . import generate
from ._derham import version as __version__
from ._meshio import from_meshio, to_meshio
from .complex import Complex, read
from .errors import Error, FileError, GeometryError, InputError, LimitError, TopologyError
from .exchange import to_pyvista
from .maps import SimplicialMap
from .point_clouds import rips
from .series import write_series
from .threads import set_thread_count, thread_count

__all__ = [
    "Complex",
    "Error",
    "FileError",
    "GeometryError",
    "InputError",
    "LimitError",
    "SimplicialMap",
    "TopologyError",
    "__version__",
    "errors",
    "from_meshio",
    "generate",
    "read",
    "rips",
    "set_thread_count",
    "thread_count",
    "to_meshio",
    "to_pyvista",
    "write_series",
]
