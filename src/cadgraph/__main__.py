"""``python -m cadgraph``."""

from cadgraph.cli import main

if __name__ == "__main__":
    main()
