"""`veduta export`: write a place in a form that others can use."""

from __future__ import annotations

SUMMARY = "Write a place as a folder that any web server can show"


def run(argv: list[str]) -> int:
    """Parse the arguments and write the export; returns the exit code."""
    import tyro

    from veduta.cli.arguments import parse
    from veduta.run.errors import InputError
    from veduta.studio.export import export_web
    from veduta.studio.options import ExportOptions

    options = parse(
        ExportOptions,
        "veduta export",
        argv,
        description=f"{SUMMARY}.",
        config=(tyro.conf.PositionalRequiredArgs, tyro.conf.FlagCreatePairsOff),
    )
    if options.web is None:
        raise InputError("--web", "it is missing", "Say where to write: `--web DIR`.")
    result = export_web(options.out, options.web, force=options.force)
    if result.written:
        print(f"{options.web}: {result.files} files, {result.size_bytes / 1e6:.1f} MB")
    else:
        print(f"{options.web}: up to date")
    print(f"To look at it: python3 -m http.server --directory {options.web} 8000")
    return 0
