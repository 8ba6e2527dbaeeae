"""
Compiled core of gyrostat.
"""
from __future__ import annotations
import typing
__all__: list[str] = ['build_info']
def build_info() -> dict[str, str | None]:
    """
    Version of the library, of the compiler, and of each library that is built in (None: it is not).
    """
