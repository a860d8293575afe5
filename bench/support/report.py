"""Reads the reports of benchmark programs (JSON of Google Benchmark)."""
import json
import statistics


class Measurement:
    """The repetitions of one benchmark "name/order/threads:t", or of one without order and threads."""

    def __init__(self, name, runs):
        parts = name.split("/")
        self.name = parts[0]
        self.order = parts[1] if len(parts) > 2 else ""
        self.threads = int(parts[2].removeprefix("threads:")) if len(parts) > 2 else 1
        self.key = "/".join(parts[:3])
        self.runs = runs
        self.error = next((run["error_message"] for run in runs if run.get("error_occurred")), None)

    def values(self, counter):
        return [run[counter] for run in self.runs if counter in run]

    def median(self, counter):
        """None if the benchmark has no such counter."""
        values = self.values(counter)
        return statistics.median(values) if values else None

    def spread(self, counter):
        """Half of the distance between the quartiles, over the median."""
        values = self.values(counter)
        if len(values) < 3 or self.median(counter) == 0:
            return None
        low, _, high = statistics.quantiles(values, n=4)
        return (high - low) / 2 / self.median(counter)


def plain(name):
    """Google Benchmark appends how it measures to the name: "/min_time:0.050/manual_time"."""
    kept = [part for part in name.split("/")
            if part != "manual_time" and not part.startswith(("iterations:", "min_time:", "repeats:"))]
    return "/".join(kept)


def measurements(report):
    """In the order in which they were registered."""
    runs = {}
    for run in sorted(report["benchmarks"], key=lambda run: run.get("family_index", 0)):
        if run["run_type"] == "iteration":
            runs.setdefault(plain(run["run_name"]), []).append(run)
    return [Measurement(name, repetitions) for name, repetitions in runs.items()]


def load(path):
    """An empty file is the report of a program in which nothing matched."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    return json.loads(text) if text else {"benchmarks": []}


def heading(report):
    context = report["context"]
    average = " ".join(f"{value:.2f}" for value in context["load_avg"])
    return (f"{context['processor']}, {context['num_cpus']} cores, load {average}, {context['date'][:16]}\n"
            f"{context['compiler']} {context['flags']}\n{context['simplices']} simplices")


def markdown(head, rows):
    """A table, aligned so that it can be read as it is. The first column is text."""
    cells = [head] + rows
    widths = [max(len(row[i]) for row in cells) for i in range(len(head))]
    def line(row):
        return "| " + " | ".join(row[i].ljust(w) if i == 0 else row[i].rjust(w) for i, w in enumerate(widths)) + " |"
    rule = "|" + "|".join("-" * (w + 2) if i == 0 else "-" * (w + 1) + ":" for i, w in enumerate(widths)) + "|"
    return "\n".join([line(head), rule] + [line(row) for row in rows])


def number(value, digits=3):
    """With so many significant digits; nothing for None."""
    if value is None:
        return ""
    if value >= 10**(digits - 1):
        return f"{value:.0f}"
    return f"{value:.{digits}g}"
