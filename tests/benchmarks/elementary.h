/* The arithmetic of graphfx in float32, operation for operation, for the C side of the benchmark.

   Every function is a few lines of straight code, so that gcc can put sixteen particles into one register.
   With -ffp-contract=off the results are graphfx's to the bit; `fmaf` stands where graphfx says fma. */

#ifndef ELEMENTARY_H
#define ELEMENTARY_H

#include <math.h>
#include <stdint.h>

#define INLINE static inline __attribute__((always_inline))

typedef struct { float x, y, z; } vec3;
typedef struct { float s, c; } circle;

INLINE float choose(int condition, float a, float b) { return condition ? a : b; }
INLINE float least(float a, float b) { return a < b ? a : b; }
INLINE float most(float a, float b) { return a > b ? a : b; }
INLINE int32_t bits_of(float x) { union { float f; int32_t i; } u = {.f = x}; return u.i; }
INLINE float of_bits(int32_t i) { union { int32_t i; float f; } u = {.i = i}; return u.f; }
INLINE float scale2(float x, float k) { return x * of_bits((int32_t)((uint32_t)((int32_t)k + 127) << 23)); }

INLINE vec3 add(vec3 a, vec3 b) { return (vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
INLINE vec3 sub(vec3 a, vec3 b) { return (vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
INLINE vec3 mul(vec3 a, float k) { return (vec3){a.x * k, a.y * k, a.z * k}; }
INLINE vec3 pick(int condition, vec3 a, vec3 b)
{
    return (vec3){choose(condition, a.x, b.x), choose(condition, a.y, b.y), choose(condition, a.z, b.z)};
}
INLINE float dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
INLINE vec3 cross(vec3 a, vec3 b)
{
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
INLINE float length(vec3 a) { return sqrtf(dot(a, a)); }
INLINE vec3 unit(vec3 a)
{
    float size = length(a);
    return mul(a, choose(size > 0.0f, 1.0f / size, 0.0f));
}

INLINE circle sincos_of(float x)
{
    float k = floorf(fmaf(x, 0.63661975f, 0.5f));
    float y = fmaf(k, 4.371139e-08f, fmaf(k, -1.5707964f, x));
    y = least(0.8f, most(-0.8f, y));
    float q = y * y;
    float s = fmaf(y * q, fmaf(q, fmaf(q, -0.0001950554f, 0.008332095f), -0.16666654f), y);
    float c = fmaf(q, fmaf(q, fmaf(q, fmaf(q, 2.4412086e-05f, -0.001388713f), 0.04166664f), -0.5f), 1.0f);
    float half_turns = floorf(k * 0.5f);
    int odd = fmaf(half_turns, -2.0f, k) > 0.0f;
    float half = half_turns * 0.5f;
    float sign = fmaf(half - floorf(half), -4.0f, 1.0f);
    return (circle){choose(odd, c, s) * sign, choose(odd, -s, c) * sign};
}

INLINE float sinc_from(float x, float sine) { return choose(x == 0.0f, 1.0f, sine / x); }
INLINE float sinc(float x) { return sinc_from(x, sincos_of(x).s); }
INLINE float cosinc(float x)
{
    float half = sinc(x * 0.5f);
    return half * half * 0.5f;
}
INLINE float sin3(float x, float wave)
{
    float q = x * x;
    float p = fmaf(q, fmaf(q, fmaf(q, 2.5644118e-08f, -2.7680305e-06f), 0.00019845094f), -0.008333368f);
    return choose(fabsf(x) < 2.0f, fmaf(q, p, 0.16666667f), (1.0f - wave) / q);
}

INLINE float power(float x, float y)
{
    int32_t b = bits_of(x);
    int32_t exponent = (int32_t)((uint32_t)b - 0x3F3504F3u) >> 23;
    float u = of_bits((int32_t)((uint32_t)b - ((uint32_t)exponent << 23))) - 1.0f;
    float e = (float)exponent;
    float p = fmaf(u, fmaf(u, -0.14697051f, 0.2098096f), -0.18752757f);
    p = fmaf(u, fmaf(u, p, 0.2005286f), -0.23955122f);
    p = fmaf(u, fmaf(u, p, 0.2887881f), -0.36070707f);
    p = fmaf(u, fmaf(u, p, 0.4808944f), -0.7213472f);
    float f = fmaf(u, fmaf(u, p, 0.44269505f), u);
    e = choose(x >= 1.17549435e-38f, choose(x < INFINITY, e, 3e38f), choose(x >= 0.0f, -3e38f, e * NAN));
    float scaled = y * e;
    float k = floorf(least(128.0f, most(-127.0f, fmaf(y, f, scaled))));
    float r = least(1.1f, most(-0.1f, fmaf(y, f, scaled - k)));
    float g = fmaf(r, fmaf(r, 0.00021565985f, 0.0012482288f), 0.009673775f);
    g = fmaf(r, fmaf(r, fmaf(r, fmaf(r, g, 0.055486184f), 0.24022909f), 0.69314706f), 1.0f);
    return scale2(g, k);
}

typedef struct { vec3 center, axis; float magnitude, tightness, range, lift; } vortex_of;

INLINE vec3 vortex(vec3 position, float dt, vortex_of v)
{
    vec3 offset = sub(position, v.center);
    float height = dot(offset, v.axis);
    vec3 radial = sub(offset, mul(v.axis, height));
    float R = length(radial);
    float near = R / v.range;
    float fade = choose(near < 1.0f, (1.0f - near * near) * (1.0f - near * near), 0.0f);
    float rate = dt * fade * power(choose(R > 0.0f, R, 1.0f), -v.tightness);
    circle turned = sincos_of(v.magnitude * rate);
    vec3 moved = add(add(add(v.center, mul(v.axis, height + v.lift * rate)), mul(radial, turned.c)),
                     mul(cross(v.axis, radial), turned.s));
    return pick(R > 0.0f, moved, position);
}

#endif
