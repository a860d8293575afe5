"""`python -m derham`: the command line, which comes with the package."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def main() -> None:
    """Becomes the program `derham` with the same arguments."""
    program = Path(__file__).parent / "bin" / "derham"
    if not program.exists():
        sys.exit(f"derham: the command line is not part of this installation ({program} is missing)")
    os.execv(program, ["derham", *sys.argv[1:]])


if __name__ == "__main__":
    main()
