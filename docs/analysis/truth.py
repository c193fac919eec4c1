"""Recall, precision, errors, late entries, missed contacts and wasted bytes of one run, from its evidence and from where everything truly was.

The places are those of `rink compare --trace` (cells/NAME.truth.jsonl); all else is computed here by the definitions of docs/metrics.md, "Truth", with nothing of the product.
"""
import json
import math

PERCENTILES = (("p50", 0.5), ("p90", 0.9), ("p95", 0.95), ("p99", 0.99), ("p999", 0.999))
LOOK_S = 4e-3  # entries are found between looks so far apart, or an eighth of a tick
ROUNDING_S = 1e-6


SHAPES = ("square", "disc")  # of what is relevant, as far as it is computed here


class Untold(Exception):
    """Why a run cannot be judged from its trace."""


class Trace:
    """Where everything was, look by look, in the order of time."""

    def __init__(self, file):
        lines = [json.loads(line) for line in file.read_text().splitlines()]
        if lines[-1].get("lines") != len(lines) - 1:
            raise Untold("its trace is cut")
        head = lines[0]
        self.shape, self.reach, self.has_team, self.always = head["shape"], head["reach"], head["team"], set(head["always"])
        self.begin_s, self.bats = head["begin_s"], head["bats"]
        self.half, self.kind, self.team = {}, {}, {}
        for thing, half_x, half_y, kind, team in head["bodies"]:
            self.half[thing], self.kind[thing], self.team[thing] = (half_x, half_y), kind, team
        self.places, self.contacts, self.put_back = {}, [], {}
        for line in lines[1:-1]:
            if "contact" in line:
                self.contacts.append(line["contact"])
                continue
            at = line["at"]
            self.places[line["t"]] = {at[i]: (at[i + 1], at[i + 2]) for i in range(0, len(at), 3)}
            self.put_back[line["t"]] = dict(line["replaced"])
        self.widest = self.reach + max(max(half) for half in self.half.values())

    def depth(self, bat, thing, place):
        """How deep `thing` is within the area around a bat at `bat`: relevant from 0 on."""
        x, y = place[0] - bat[0], place[1] - bat[1]
        if self.shape == "disc":
            return self.reach - math.hypot(x, y)
        return min(self.reach + self.half[thing][0] - abs(x), self.reach + self.half[thing][1] - abs(y))

    def binned(self, places):
        cells = {}
        for thing, (x, y) in places.items():
            cells.setdefault((math.floor(x / self.widest), math.floor(y / self.widest)), []).append(thing)
        return cells

    def relevant(self, places, cells, own):
        """{thing: depth} of what is relevant to the bat `own`."""
        bat = places[own]
        column, row = math.floor(bat[0] / self.widest), math.floor(bat[1] / self.widest)
        found = {}
        for x in (column - 1, column, column + 1):
            for y in (row - 1, row, row + 1):
                for thing in cells.get((x, y), ()):
                    depth = self.depth(bat, thing, places[thing])
                    if depth >= 0.0 and thing != own:
                        found[thing] = depth
        for thing in places if self.has_team or self.always else ():
            is_mate = self.has_team and self.kind[thing] == "bat" and self.team[thing] == self.team[own] != 0
            if thing != own and (is_mate or self.kind[thing] in self.always):
                found[thing] = math.inf
        return found


class Scope:
    """What one player had been told of, forward in time."""

    def __init__(self, steps):
        self.steps, self.next, self.since = steps, 0, {}

    def advance(self, instant):
        while self.next < len(self.steps) and self.steps[self.next][0] <= instant:
            when, thing, is_in = self.steps[self.next]
            if not is_in:
                self.since.pop(thing, None)
            else:
                self.since.setdefault(thing, when)
            self.next += 1


class Player:
    def __init__(self, bat, steps):
        self.bat, self.steps = bat, steps
        self.told, self.told_at_contacts = Scope(steps), Scope(steps)
        self.stays, self.looks, self.last, self.late = {}, 0, 0.0, []  # stays: thing -> [begin, is settled]

    def look(self, instant, relevant, passed):
        """A stay begins where its depth, taken as linear between looks, passes 0; it is late until its first delivered state, or to its end."""
        self.looks += 1
        for thing, depth in relevant.items():
            if thing not in self.stays:
                part = 1.0 if self.looks == 1 else passed(self.bat, thing, depth)
                self.stays[thing] = [self.last + (instant - self.last) * part, self.looks == 1]
            stay = self.stays[thing]
            if not stay[1] and thing in self.told.since:
                self.late.append(max(0.0, self.told.since[thing] - stay[0]))
                stay[1] = True
        self.last = instant
        for thing in [thing for thing in self.stays if thing not in relevant]:
            self.close(self.stays.pop(thing), instant)

    def close(self, stay, instant):
        if not stay[1]:
            self.late.append(instant - stay[0])

    def end(self):
        for stay in self.stays.values():
            self.close(stay, self.last)


class Sets:
    """Sizes of what was chosen, what was relevant and what was both, over all samples."""

    def __init__(self):
        self.chosen = self.relevant = self.both = 0

    def add(self, chosen, relevant):
        self.chosen += len(chosen)
        self.relevant += len(relevant)
        self.both += sum(thing in relevant for thing in chosen)

    def figures(self, name):
        figures = {}
        if self.chosen:
            figures[name + "_precision"] = self.both / self.chosen
        if self.relevant:
            figures[name + "_recall"] = self.both / self.relevant
        return figures


def percentiles(values, name, factor):
    """Order statistics beyond which ten samples lie, and the largest."""
    values, figures = sorted(values), {}
    for suffix, fraction in PERCENTILES:
        if values and len(values) * (1 - fraction) >= 10 - 1e-6:
            figures[f"{name}_{suffix}"] = factor * values[math.ceil(fraction * len(values)) - 1]
    if values:
        figures[name + "_max"] = factor * values[-1]
    return figures


class Errors:
    """Distances [m] between where entities were believed to be and where they were, those put back unheard of apart."""

    def __init__(self):
        self.distances, self.of_replaced = [], []

    def figures(self, name):
        figures = percentiles(self.distances, name, 1e3)
        for absent in ("_p95", "_p999"):
            figures.pop(name + absent, None)
        for suffix, distances in (("_rms", self.distances), ("_replaced_rms", self.of_replaced)):
            if distances:
                figures[name + suffix] = 1e3 * math.sqrt(math.fsum(distance * distance for distance in distances) / len(distances))
        if self.distances or self.of_replaced:
            figures[name + "_replaced_samples"] = len(self.of_replaced)
        return figures


def judged(server, bots, trace_file):
    """The figures of truth of one run, by the lines of its evidence without their last, and why they are not all, or nothing; throws Untold."""
    if not trace_file.exists():
        raise Untold("needs the game played again (rink compare --trace)")
    trace = Trace(trace_file)
    head, bodies = server[0], {}
    for line in server:
        bodies.update(line.get("objects", ()))
    players = []
    for line in bots:
        if "changes_us" in line:
            steps = sorted(((1e-6 * instant, bodies[thing], is_in) for instant, thing, is_in in line["changes_us"] if thing in bodies), key=lambda step: step[0])
            players.append(Player(bodies.get(line["bat"]), steps))
    if trace.shape not in SHAPES:
        return contact_figures(trace, bots, players), f"relevance by {trace.shape} is not computed here"
    samples = [line for line in bots if "entities_nm" in line]
    looks = planned(head, server, samples, trace.begin_s)
    filtered, delivered, shown, stamped = Sets(), Sets(), Errors(), Errors()
    bytes_all, bytes_wasted, before, looked, cells = 0, 0, {}, None, {}

    def passed(own, thing, depth):
        if own not in before or thing not in before:
            return 1.0
        was = trace.depth(before[own], thing, before[thing])
        return was / (was - depth) if was < 0.0 else 1.0

    def is_put_back_unheard(sample, entry, thing):
        since = trace.put_back[looked].get(thing)
        if since is None:
            return False
        if sample["matched_s"] < since - ROUNDING_S:
            return True
        if entry[1] > 0 or since <= sample["displayed_s"] - sample["window_s"]:
            return False
        return not any(is_in and what == thing and since <= when <= sample["displayed_s"] for when, what, is_in in players[sample["bot"]].steps)

    def add_errors(sample, relevant, at_displayed, errors):
        nonlocal bytes_all, bytes_wasted
        for entry in sample["entities_nm"]:
            thing = bodies.get(entry[0])
            if thing is None or thing == players[sample["bot"]].bat:
                continue
            if at_displayed:
                bytes_all += entry[1]
                bytes_wasted += entry[1] if thing not in relevant else 0
            if len(entry) == 2 or thing not in relevant:
                continue
            believed = entry[4:6] if at_displayed and len(entry) == 6 else entry[2:4]
            place = places[thing]
            of = errors.of_replaced if is_put_back_unheard(sample, entry, thing) else errors.distances
            of.append(math.hypot(believed[0] / 1e9 - place[0], believed[1] / 1e9 - place[1]))

    for instant, kind, what in looks:
        if instant != looked:
            looked, places = instant, trace.places[instant]
            cells = trace.binned(places)
        if kind == "step":
            for player in players:
                if player.bat in places:
                    player.told.advance(instant)
                    player.look(instant, trace.relevant(places, cells, player.bat), passed)
            before = places
        elif kind == "decision":
            bat = trace.bats[what["player"]]
            if bat is not None:
                objects = (thing for first, count in zip(what["in_scope"][::2], what["in_scope"][1::2]) for thing in range(first, first + count))
                chosen = [bodies[thing] for thing in objects if thing in bodies and bodies[thing] != bat]
                filtered.add(chosen, trace.relevant(places, cells, bat))
        else:
            player = players[what["bot"]]
            if player.bat not in places:
                continue
            relevant = trace.relevant(places, cells, player.bat)
            if kind == "displayed":
                player.told.advance(instant)
                delivered.add([thing for thing in player.told.since if thing != player.bat], relevant)
                add_errors(what, relevant, True, shown)
            else:
                add_errors(what, relevant, False, stamped)
    figures = filtered.figures("filter")
    if not bots[0]["is_complete"] or not players:
        return figures, ""
    for player in players:
        player.end()
    figures.update(delivered.figures("delivered"))
    figures.update(percentiles([late for player in players for late in player.late], "late_entry_ms", 1e3))
    for name, errors in (("displayed_error_mm", shown), ("position_error_mm", stamped)):
        figures.update(errors.figures(name))
    figures.update(contact_figures(trace, bots, players))
    if bytes_all:
        figures["wasted_bytes_fraction"] = bytes_wasted / bytes_all
    return figures, ""


def contact_figures(trace, bots, players):
    """Contacts of watched players' bats, and how many of the players did not know of the other body."""
    if not bots[0]["is_complete"] or not players:
        return {}
    contacts = missed = 0
    for instant, *pair in trace.contacts:
        for player in players:
            for own, other in (pair, pair[::-1]):
                if player.bat == own:
                    player.told_at_contacts.advance(instant)
                    contacts += 1
                    missed += other not in player.told_at_contacts.since
    return {"interactions": contacts, "missed_interactions": missed}


def planned(head, server, samples, begin_s):
    """All instants at which something is judged, in the order of time; what falls together in the order of the evidence."""
    step = min(LOOK_S, 0.125 / head["rate_hz"])
    looks, until, i = [], min(head["until_s"], head["end_s"]), 0
    while head["from_s"] + i * step <= until:
        looks.append((head["from_s"] + i * step, "step", None))
        i += 1
    looks += [(line["instant_s"], "decision", line) for line in server if "in_scope" in line]
    for sample in samples:
        looks.append((sample["displayed_s"], "displayed", sample))
        looks.append((sample["matched_s"], "matched", sample))
    return sorted((look for look in looks if begin_s <= look[0] <= head["end_s"]), key=lambda look: look[0])
