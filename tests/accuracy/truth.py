#!/usr/bin/env python3
"""Prints truth.csv: what becomes of small scenes, in 60-digit arithmetic, to 50 digits.

Independent of the engine: each pair's gap is sampled along the closed-form motion every half millisecond, every change of sign (and every dip that may hide two) is
bisected to 55 digits, and the impact follows Newton's law. Scene files are read as doubles, so that the constants hold for exactly the numbers that the engine gets.

usage: tests/accuracy/truth.py > tests/accuracy/truth.csv      (Python 3.11 and mpmath; a quarter of a minute)
       tests/accuracy/truth.py --check                         compares truth.csv with what it would print; exit status 1 if they differ

Columns: scene, time at which it stops [s], body, impacts until then, the least cosine between normal and relative velocity of its round contacts, x, y [m], vx, vy [m/s].
"""

import math
import pathlib
import sys
import tomllib

from mpmath import mp, mpf

mp.dps = 60
scenes = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "accuracy"
directions = {"left": (-1, 0), "right": (1, 0), "up": (0, 1), "down": (0, -1)}
sampling = mpf(1) / 2048


class Float:
    """Arithmetic for sampling: doubles find brackets fast, and mpf refines them."""
    number, exp, sqrt = float, math.exp, math.sqrt


class Exact:
    number, exp, sqrt = mpf, mp.exp, mp.sqrt


class Body:
    def __init__(self, kind, table, drag, name, friction=0.0):
        self.kind, self.name = kind, table.get("name", name)
        self.x = [mpf(c) for c in table["position"]]
        self.v = [mpf(c) for c in table.get("velocity", (0.0, 0.0))]
        self.radius = mpf(table.get("radius", 0.04)) if kind != "bat" else mpf(0)
        self.half = [mpf(c) for c in table.get("half_extent", (0.0, 0.0))]
        self.inverse_mass = mpf(0) if kind == "post" else 1 / mpf(table.get("mass", 1.0))
        self.drag, self.thrust, self.keys = mpf(drag), mpf(table.get("thrust", 10.0)), set()
        self.a, self.time, self.friction = [mpf(0), mpf(0)], mpf(0), mpf(friction)

    def at(self, time, how):
        """Position and velocity of dv/dt = a - g v, or of dv/dt = -friction v/|v| until the body rests."""
        n, t = how.number, how.number(time - self.time)
        if self.friction > 0:
            x, v = [n(c) for c in self.x], [n(c) for c in self.v]
            speed, lost = how.sqrt(v[0] ** 2 + v[1] ** 2), n(self.friction) * t
            left = max(speed - lost, n(0))
            way = (speed + left) / 2 * min(t, speed / n(self.friction))
            return [[c + w * way / speed for c, w in zip(x, v)], [w * left / speed for w in v]] if speed > 0 else [x, v]
        g, result = n(self.drag), ([], [])
        if g == 0:
            s, q, e = t, t * t / 2, n(1)
        elif how is Float and g * t < 1e-2:
            y = g * t  # (t - s)/g cancels in doubles; samples need no more than this
            s, q, e = t * (1 - y / 2 + y * y / 6 - y**3 / 24), t * t * (0.5 - y / 6 + y * y / 24), math.exp(-y)
        else:
            e = how.exp(-g * t)
            s = (1 - e) / g
            q = (t - s) / g
        for x, v, a in zip(self.x, self.v, self.a):
            result[0].append(n(x) + n(v) * s + n(a) * q)
            result[1].append(n(v) * e + n(a) * s)
        return result

    def move(self, time):
        self.x, self.v = self.at(time, Exact)
        self.time = time


class Wall:
    def __init__(self, axis, side, place):
        self.kind, self.axis, self.side, self.place = "wall", axis, side, mpf(place)
        self.inverse_mass, self.v = mpf(0), [mpf(0), mpf(0)]

    def move(self, time):
        pass


def gap(a, b, time, how):
    """Distance between the surfaces of `a` and `b` and the unit normal from `b` to `a`; a rectangle grown by a radius has rounded corners."""
    x = a.at(time, how)[0]
    n = how.number
    if b.kind == "wall":
        normal = [n(0), n(0)]
        normal[b.axis] = n(b.side)
        return (x[b.axis] - n(b.place)) * b.side - n(a.radius + a.half[b.axis]), normal
    offset = [p - q for p, q in zip(x, b.at(time, how)[0])]
    reach = n(a.radius + b.radius)
    outside = [abs(o) - n(h + k) for o, h, k in zip(offset, a.half, b.half)]
    if min(outside) > 0:
        length = how.sqrt(outside[0] ** 2 + outside[1] ** 2)
        return length - reach, [math.copysign(1, o) * d / length for o, d in zip(offset, outside)]
    axis = 0 if outside[0] >= outside[1] else 1
    normal = [n(0), n(0)]
    normal[axis] = n(1 if offset[axis] > 0 else -1)
    return outside[axis] - reach, normal


def closing(a, b, time, normal):
    velocity = b.v if b.kind == "wall" else b.at(time, Exact)[1]
    return sum(n * (w - v) for n, v, w in zip(normal, a.at(time, Exact)[1], velocity))


def bisected(a, b, low, high):
    for _ in range(190):
        middle = (low + high) / 2
        if gap(a, b, middle, Exact)[0] > 0:
            low = middle
        else:
            high = middle
    return low


def dip(a, b, low, high):
    """The time of the least gap between `low` and `high`, where it has one minimum."""
    for _ in range(60):
        left, right = low + (high - low) / 3, high - (high - low) / 3
        if gap(a, b, left, Exact)[0] < gap(a, b, right, Exact)[0]:
            high = right
        else:
            low = left
    return (low + high) / 2


def first_impact(a, b, start, until):
    """The first time in (start, until] at which the pair touches and closes, or nothing."""
    distance, normal = gap(a, b, start, Exact)
    if distance < mpf(10) ** -50 and closing(a, b, start, normal) > mpf(10) ** -40:
        return start
    times, values = [start], [max(float(distance), 0.0)]
    while times[-1] < until:
        times.append(min(times[-1] + sampling, until))
        values.append(gap(a, b, times[-1], Float)[0])
        if values[-1] <= 1e-9 and len(times) > 2:  # near the rounding of doubles, or past it
            if gap(a, b, times[-1], Exact)[0] <= 0:
                return bisected(a, b, times[-2], times[-1])
        if len(times) > 2 and values[-2] < 1e-3 and values[-3] > values[-2] < values[-1]:
            least = dip(a, b, times[-3], times[-1])
            if gap(a, b, least, Exact)[0] < 0:
                return bisected(a, b, times[-3], least)
        assert not (len(times) == 2 and values[-1] <= 0), "an impact within the first sample"
    return None


def collide(a, b, time, restitution):
    """Newton's law of impact; returns the cosine between normal and relative velocity of a round contact, whose normal depends on where it is."""
    a.move(time)
    b.move(time)
    normal = gap(a, b, time, Exact)[1]
    relative = [w - v for v, w in zip(a.v, b.v)]
    approach = sum(n * w for n, w in zip(normal, relative))
    impulse = (1 + restitution) * approach / (a.inverse_mass + b.inverse_mass)
    a.v = [v + impulse * a.inverse_mass * n for v, n in zip(a.v, normal)]
    if b.kind != "wall":
        b.v = [v - impulse * b.inverse_mass * n for v, n in zip(b.v, normal)]
    is_flat = 0 in normal and (b.kind == "wall" or "bat" in (a.kind, b.kind))
    return mpf(1) if is_flat else approach / mp.sqrt(relative[0] ** 2 + relative[1] ** 2)


def play(name, until):
    table = tomllib.loads((scenes / (name + ".toml")).read_text())
    field, drag = table["field"], table.get("drag", {})
    friction = table.get("friction", {}).get("pucks", 0.0)
    restitution = mpf(table.get("materials", {}).get("restitution", 1.0))
    bodies = [Body("post", t, 0.0, f"post-{i}") for i, t in enumerate(table.get("post", []))]
    bodies += [Body("bat", t, drag.get("bats", 0.0), f"bat-{i}") for i, t in enumerate(table.get("bat", []))]
    bodies += [Body("puck", t, drag.get("pucks", 0.0), f"puck-{i}", friction) for i, t in enumerate(table.get("puck", []))]
    walls = [Wall(0, 1, 0.0), Wall(0, -1, field["length"]), Wall(1, 1, 0.0), Wall(1, -1, field["width"])]
    moving = [b for b in bodies if b.kind != "post"]
    pairs = [(a, b) for a in moving for b in bodies if a is not b and (b.kind == "post" or bodies.index(a) < bodies.index(b))] + [(a, w) for a in moving for w in walls]
    keys = sorted(table.get("key", []), key=lambda k: k["time"])
    now, impacts, cosine = mpf(0), 0, mpf(1)
    while now < until or keys:
        limit = min(mpf(until), mpf(keys[0]["time"])) if keys else mpf(until)
        found = [(t, pair) for pair in pairs if (t := first_impact(*pair, now, limit)) is not None] if limit > now else []
        if found:
            now, (a, b) = min(found, key=lambda f: f[0])
            cosine = min(cosine, collide(a, b, now, restitution))
            impacts += 1
            continue
        now = limit
        if not keys:
            break
        key = keys.pop(0)
        bat = next(b for b in bodies if b.name == key["bat"])
        bat.move(now)
        (bat.keys.add if key["is_down"] else bat.keys.discard)(key["key"])
        bat.a = [bat.thrust * sum(directions[k][axis] for k in bat.keys) for axis in (0, 1)]
    for body in moving:
        position, velocity = body.at(mpf(until), Exact)
        yield ",".join([name, repr(until), body.name, str(impacts), mp.nstr(cosine, 20)] + [mp.nstr(c, 50) for c in position + velocity])


stops = {"pair-*": 1.0, "bat-*": 1.0, "bat-three-roots": 0.6, "friction-*": 1.5}


def lines():
    yield "scene,until,body,impacts,cosine,x,y,vx,vy"
    for name in sorted(f.stem for f in scenes.glob("*.toml")):
        fitting = [until for pattern, until in stops.items() if pathlib.PurePath(name).match(pattern)]
        if fitting:
            yield from play(name, fitting[-1])


def main():
    if "--check" in sys.argv:
        sys.exit(pathlib.Path(__file__).with_name("truth.csv").read_text().splitlines() != list(lines()))
    for line in lines():
        print(line, flush=True)


main()
