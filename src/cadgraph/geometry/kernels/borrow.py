"""Arrays passed between compiled kernels without counting references.

Numba counts the references to an array in every kernel that takes it, with locked instructions: in kernels called
for each pair of triangles that is half of the time. A borrowed array refers to nobody's memory as far as numba
knows, so there is nothing to count. Whoever lends it must hold the array while it is in use: borrow only arrays that
are arguments of the kernel that borrows.
"""

from __future__ import annotations

from typing import Any

from numba.extending import intrinsic
from numba.np.arrayobj import make_array

__all__ = ["borrow"]


def _borrow(typing_context: Any, array: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        lent = make_array(signature.args[0])(context, builder, arguments[0])
        lent.meminfo = lent.meminfo.type(None)
        lent.parent = lent.parent.type(None)
        return lent._getvalue()

    return array(array), generate


borrow: Any = intrinsic(_borrow)
"""``borrow(array)`` is the same array, of which kernels count no references; in compiled kernels only."""
