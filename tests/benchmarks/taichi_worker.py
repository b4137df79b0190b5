"""The Taichi side of the simulation benchmark, a process of its own: `taichi_worker.py EFFECT THREADS`.

It reads one order a line, as JSON, and answers each with one. One kernel a substep, as one would write it;
Taichi's own settings, fast-math included.
"""

import json
import sys
import time

import numpy as np
import taichi as ti

EFFECT, THREADS = sys.argv[1], int(sys.argv[2])
ti.init(arch=ti.cpu, cpu_max_num_threads=THREADS, log_level=ti.ERROR)
real, Vec = ti.f32, ti.math.vec3
given = np.load(sys.argv[3])
COUNT = len(given["arr_0"])
position, velocity, axes, tail = (ti.Vector.field(3, real, COUNT, layout=ti.Layout.SOA) for _ in range(4))
speed = ti.field(real, COUNT)
numbers = ti.field(real, 65 if EFFECT == "ten_operators" else 35)


@ti.func
def vec(k):
    return Vec(numbers[k], numbers[k + 1], numbers[k + 2])


@ti.func
def vortex(place, dt, k: ti.template()):
    axis = vec(k + 3)
    offset = place - vec(k)
    height = offset.dot(axis)
    radial = offset - axis * height
    R = radial.norm()
    near = R / numbers[k + 8]
    moved = place
    if R > 0 and near < 1:
        rate = dt * (1 - near * near) ** 2 * R ** -numbers[k + 7]
        angle = numbers[k + 6] * rate
        moved = vec(k) + axis * (height + numbers[k + 9] * rate) + radial * ti.cos(angle) + axis.cross(radial) * ti.sin(angle)
    return moved


@ti.func
def bounce(p: ti.template(), v: ti.template(), distance, normal, resilience, friction, threshold):
    if distance < 0:
        along = normal * v.dot(normal)
        slowed = friction
        if v.norm() < threshold:
            slowed = 0.0
        v = (v - along) * (1 - slowed) - along * resilience
        p = p - normal * (distance * 2)


@ti.kernel
def ten_substep(count: int):
    for i in range(count):
        dt = numbers[64]
        p, v = position[i], velocity[i]
        before = v
        v = (v + vec(0) * dt) * ti.max(1 - numbers[3] * dt, 0)
        axis = axes[i] / axes[i].norm()
        angle = speed[i] * dt
        v = v * ti.cos(angle) + axis.cross(v) * ti.sin(angle) + axis * (axis.dot(v) * (1 - ti.cos(angle)))
        p = vortex(p, dt, 4)
        p = vortex(p, dt, 14)
        p += (before + v) * (dt * 0.5)
        bounce(p, v, (p - vec(27)).dot(vec(24)), vec(24), numbers[31], numbers[32], numbers[33])
        for s in ti.static(range(34, 64, 10)):
            offset = p - vec(s + 3)
            R = offset.norm()
            if R > 0:
                bounce(p, v, R - numbers[s + 6], offset / R, numbers[s + 7], numbers[s + 8], numbers[s + 9])
        position[i] = p
        velocity[i] = v


@ti.func
def spin(p: ti.template(), v: ti.template(), axis, rate, dt):
    angle = rate * dt
    s, c = ti.sin(angle), ti.cos(angle)
    wave, bow = dt, 0.0
    if ti.abs(angle) > 0:
        wave, bow = s / angle * dt, (1 - c) / angle * dt
    along, turned = axis.dot(v), axis.cross(v)
    p += v * wave + turned * bow + axis * (along * (dt - wave))
    v = v * c + turned * s + axis * (along * (1 - c))


@ti.kernel
def snow_step(count: int):
    for i in range(count):
        dt, half = numbers[28], numbers[29]
        p, v, axis = position[i], velocity[i], axes[i] / axes[i].norm()
        before = p
        spin(p, v, axis, speed[i], half)
        p = vortex(p, half, 0)
        p = vortex(p, dt, 10)
        p = vortex(p, half, 0)
        spin(p, v, axis, speed[i], half)
        if (p - vec(20)).dot(vec(23)) >= 0:
            tail[i] = (before + (p - before) * ((numbers[32] - numbers[30]) / (numbers[31] - numbers[30])))
            position[i] = p
            velocity[i] = v


def advance(parameters: list[float]) -> dict:
    numbers.from_numpy(np.array(parameters, np.float32))
    ti.sync()
    began = time.process_time(), time.perf_counter()
    if EFFECT == "ten_operators":
        for _ in range(4):
            ten_substep(COUNT)
    else:
        snow_step(COUNT)
    ti.sync()
    return {"cpu": time.process_time() - began[0], "wall": time.perf_counter() - began[1]}


def load(file: str) -> None:
    with np.load(file) as columns:
        arrays = [columns[name] for name in columns.files]
    vectors = (position, velocity, axes, *((tail,) if EFFECT == "snow" else ()))
    for k, field in enumerate(vectors):
        field.from_numpy(np.stack(arrays[3 * k : 3 * k + 3], axis=1))
    speed.from_numpy(arrays[3 * len(vectors)])


def save(file: str) -> None:
    np.savez(file, *(field.to_numpy()[:, k] for field in (position, velocity) for k in range(3)))


for line in sys.stdin:
    order = json.loads(line)
    answer: dict = {}
    if order["do"] == "load":
        load(order["file"])
    elif order["do"] == "save":
        save(order["file"])
    else:
        answer = advance(order["parameters"])
    print(json.dumps(answer), flush=True)
