"""What `python3 -m contactsim VERB` does. contactctl hands over here for all that is drawn, with the
server in the environment; see address_of and open_channel."""

from __future__ import annotations

import argparse
import math
import pathlib
import sys
import time
from typing import Callable, Sequence

import numpy as np

from .client import Client
from .errors import (ContactError, InvalidScenario, JobNotFound, NotAllowed, Overloaded, Timeout,
                     Unreachable)
from .figures import PRESETS, Figure, FigureError, channels_figure, presets_figure
from .figures.axes import require_units
from .figures.coarse import FEW_SAMPLES, coarse_cycles
from .figures.figure import Curve, Kind, Panel, points_csv
from .figures.look import PRINT, Look, parse_font, parse_size
from .figures.overlay import measured_figure, overlay_figure
from .figures.shown import Part
from .figures.sources import printable
from .figures.sweeps import heat_map, require_map, sweep_line
from .pages import write_report
from .paper.damping import ideal
from .paper.items import summary
from .paper.make import ITEMS, write_paper
from .result import Result

# Exit codes, those of contactctl.
_FAILED, _USAGE, _DIFFERS, _LOCAL, _INTERRUPTED = 1, 2, 8, 11, 130
_CODES: Sequence[tuple[type[Exception], int]] = (
    (InvalidScenario, 3), (Unreachable, 4), (Timeout, 5), (JobNotFound, 6), (NotAllowed, 9),
    (Overloaded, 10), (ValueError, _USAGE), (ContactError, _FAILED))
_NO_FIGURES = "figures are not drawn: apt-get install python3-matplotlib"


def main(words: Sequence[str] | None = None) -> int:
    """Runs a verb and returns its exit code."""
    arguments = _parser().parse_args(words)
    try:
        code: int = arguments.act(arguments)
        return code
    except KeyboardInterrupt:
        return _INTERRUPTED
    except ModuleNotFoundError as missing:
        _tell(f"contactsim: {missing.name} is not installed: apt-get install "
              f"python3-{missing.name}")
        return _LOCAL
    except (ContactError, ValueError) as error:
        _tell(f"contactsim: {error}")
        return next(code for kind, code in _CODES if isinstance(error, kind))
    except OSError as error:
        _tell(f"contactsim: {error.filename}: {error.strerror}")
        return _LOCAL


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python3 -m contactsim", allow_abbrev=False)
    parser.add_argument("--timeout", type=float, default=10.0, help="of a call, in s")
    verbs = parser.add_subparsers(dest="verb", required=True)

    def add(name: str, act: Callable[[argparse.Namespace], int], about: str
            ) -> argparse.ArgumentParser:
        verb = verbs.add_parser(name, help=about, allow_abbrev=False)
        verb.set_defaults(act=act)
        return verb

    plot = add("plot", _plot, "draw a job that has ended")
    plot.add_argument("job")
    plot.add_argument("presets", nargs="*", metavar="preset", help=", ".join(PRESETS))
    plot.add_argument("--channels", action="append", default=[])
    plot.add_argument("--contacts", action="append", default=[])
    plot.add_argument("--from", type=float, default=-math.inf, dest="start")
    plot.add_argument("--to", type=float, default=math.inf, dest="end")
    plot.add_argument("--log", action="store_true")
    plot.add_argument("--keep", type=pathlib.Path)
    _add_look(plot)
    _add_file(plot)

    overlay = add("overlay", _overlay, "draw runs over each other")
    overlay.add_argument("jobs", nargs="+")
    overlay.add_argument("--channels", action="append", default=[])
    _add_file(overlay)

    measured = add("measured", _measured, "draw measured data over a run")
    measured.add_argument("job")
    measured.add_argument("table")
    measured.add_argument("--map", action="append", default=[])
    measured.add_argument("--shift", type=float, default=0.0)
    _add_file(measured)

    heat = add("heatmap", _heat_map, "draw a metric of a sweep")
    heat.add_argument("job")
    heat.add_argument("--metric", default="")
    heat.add_argument("--scale", choices=("linear", "log"), default="linear")
    heat.add_argument("--contour", action="store_true")
    _add_file(heat)

    curves = add("curves", _curves, "draw columns of CSV from the standard input")
    curves.add_argument("--title", default="")
    curves.add_argument("--y-label", default="")
    curves.add_argument("--ideal", action="store_true", help="with the dotted line y = x")
    _add_file(curves)

    report = add("report", _report, "write a page about runs")
    report.add_argument("jobs", nargs="+")
    report.add_argument("--file", default="report.html")

    paper = add("paper", _paper, "make figures and tables of the paper again")
    paper.add_argument("items", nargs="*", help=", ".join(ITEMS))
    paper.add_argument("--directory", default="paper")
    paper.add_argument("--format", default="")
    return parser


def _add_file(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--file", default="", help="where to; without it txt is printed")
    parser.add_argument("--format", default="")
    parser.add_argument("--columns", type=int, default=80, help="of txt")


def _add_look(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--style", choices=("colour", *PRINT), default="colour")
    parser.add_argument("--size")
    parser.add_argument("--font")
    parser.add_argument("--unit", action="append", default=[])
    parser.add_argument("--no-title", action="store_true")
    parser.add_argument("--no-provenance", action="store_true")


def _look_of(arguments: argparse.Namespace) -> Look:
    family, points = parse_font(arguments.font) if arguments.font is not None else ("", 0.0)
    return Look(size=parse_size(arguments.size) if arguments.size is not None else None,
                family=family, points=points, style=arguments.style,
                title=not arguments.no_title, provenance=not arguments.no_provenance,
                units=arguments.unit)


def _write(figure: Figure, arguments: argparse.Namespace, look: Look = Look()) -> None:
    """To a file, whose path is printed; csv without matplotlib."""
    form = arguments.format or pathlib.Path(arguments.file).suffix.lstrip(".").lower() or "svg"
    if form == "csv" and arguments.file:
        pathlib.Path(arguments.file).write_text(points_csv(figure), "utf-8")
    elif form == "txt" and not arguments.file:
        from .figures import characters

        sys.stdout.write(characters.text(figure, arguments.columns, look))
        return
    else:
        from .figures.files import save

        save(figure, arguments.file, form, look, arguments.columns)


def _plot(arguments: argparse.Namespace) -> int:
    look = _look_of(arguments)
    if bool(arguments.presets) == bool(arguments.channels):
        raise FigureError("say what to draw: either presets, or --channels")
    part = Part(arguments.contacts, arguments.start, arguments.end)
    with _client(arguments) as client:
        result = client.result(arguments.job, failed=True)
    figure = (presets_figure(arguments.presets, result, part) if arguments.presets else
              channels_figure(arguments.channels, result, part))
    require_units(figure.panels, look.units)
    if arguments.log:
        _make_log(figure)
    if not figure.panels[0].counted_x:
        _tell_coarse(result)
    if arguments.keep is not None:
        _keep(figure, arguments)
    _write(figure, arguments, look)
    if arguments.file:
        print(arguments.file)
    return 0


def _make_log(figure: Figure) -> None:
    for panel in figure.panels:
        if panel.kind is Kind.WATERFALL:
            raise FigureError("--log: a waterfall has no axis of values")
        if not any((curve.y > 0).any() for curve in panel.curves):
            raise FigureError(f"--log: {panel.y_label} has no value above 0")
        panel.log_y, panel.lowest_y = True, None


def _tell_coarse(result: Result) -> None:
    """Of cycles that have too few samples to be seen, and the command that records more."""
    if "time" not in result.arrays:
        return
    coarse = len(coarse_cycles(result.job.cycles, result["time"]))
    if coarse:
        cycles = "contact cycle has" if coarse == 1 else "contact cycles have"
        _tell(f"{coarse} {cycles} fewer than {FEW_SAMPLES} samples, too few to show. For more:\n"
              f"  contactctl run --like {result.name} --set output.samples_per_contact=100")


def _keep(figure: Figure, arguments: argparse.Namespace) -> None:
    """The data as CSV, and a script that draws them with matplotlib, to begin with."""
    from .figures.script import script

    name = "-".join(arguments.presets) or "channels"
    arguments.keep.mkdir(parents=True, exist_ok=True)
    (arguments.keep / f"{name}.csv").write_text(points_csv(figure), "utf-8")
    (arguments.keep / f"{name}.py").write_text(script(figure, name), "utf-8")


def _overlay(arguments: argparse.Namespace) -> int:
    with _client(arguments) as client:
        runs = [client.result(job, failed=True) for job in arguments.jobs]
    _write(overlay_figure(runs, arguments.channels), arguments)
    return 0


def _measured(arguments: argparse.Namespace) -> int:
    map_ = dict(pair.split("=", 1) for pair in arguments.map)
    with _client(arguments) as client:
        result = client.result(arguments.job, failed=True)
    compared = result.compare_measured(arguments.table, map=map_, shift_s=arguments.shift)
    _write(measured_figure(compared, arguments.table), arguments)
    return 0


def _heat_map(arguments: argparse.Namespace) -> int:
    with _client(arguments) as client:
        sweep = client.sweep_result(arguments.job, failed=True)
    metric = arguments.metric or sweep.metrics[0]
    log = arguments.scale == "log"
    if len(sweep.axes) == 1:
        _write(sweep_line(sweep, metric, log), arguments)
        return 0
    from .figures.maps import save_map

    require_map(sweep)
    save_map(heat_map(sweep, metric, log), arguments.file, arguments.contour)
    return 0


def _curves(arguments: argparse.Namespace) -> int:
    names = sys.stdin.readline().rstrip("\n").split(",")
    x, *columns = np.loadtxt(sys.stdin, delimiter=",", ndmin=2).T
    curves = [Curve(name, place, x, y) for place, (name, y) in enumerate(zip(names[1:], columns))]
    if arguments.ideal:
        curves.append(ideal())
    panel = Panel(names[0], arguments.y_label, curves)
    _write(Figure(arguments.title, [panel], most_colours=len(columns)), arguments)
    if arguments.file:
        print(arguments.file)
    return 0


def _report(arguments: argparse.Namespace) -> int:
    with _client(arguments) as client:
        path, drawn = write_report(client, arguments.jobs, arguments.file)
    if not drawn:
        _tell(_NO_FIGURES)
    _tell(f"{path}  {(path.stat().st_size + 999) // 1000} kB, opens offline")
    return 0


def _paper(arguments: argparse.Namespace) -> int:
    start = time.monotonic()
    if arguments.format:
        import matplotlib  # noqa: F401  # Who asks for a format is told if it cannot be drawn.
    with _client(arguments) as client:
        items, drawn = write_paper(client, arguments.items, arguments.directory,
                                   arguments.format or "svg")
    sys.stdout.write(summary(items))
    sys.stdout.flush()
    if not drawn and any(item.figure or item.map for item in items):
        _tell(_NO_FIGURES)
    count = f"{len(items)} item{'s' * (len(items) != 1)}"
    _tell(f"{count}, {drawn} drawn, index.html in {arguments.directory}, in "
          f"{time.monotonic() - start:.4g} s")
    return 0 if all(item.holds for item in items) else _DIFFERS


def _client(arguments: argparse.Namespace) -> Client:
    return Client(timeout_s=arguments.timeout)


def _tell(text: str) -> None:
    """To the standard error, without what steers a terminal."""
    print(printable(text, "\n"), file=sys.stderr)
