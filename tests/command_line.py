"""Commands run within the process."""

from cadgraph.cli import main


def run(capsys, *arguments):
    """The exit code, standard output and standard error of one command."""
    code = 0
    try:
        main([str(a) for a in arguments])
    except SystemExit as end:
        code = end.code or 0
    out, err = capsys.readouterr()
    return code, out, err


def refused(capsys, *arguments):
    """The one line of an error that ends with code 2."""
    code, _, err = run(capsys, *arguments)
    assert code == 2
    lines = [line for line in err.splitlines() if line.startswith("error:")]
    assert len(lines) == 1
    assert "Traceback" not in err
    return lines[0]
