/* Ten operators by the paper's scheme, as ten_operators.json has them: gravity, damp, spiral, two vortices, move,
   bounce off a plane and three spheres. Structure of arrays, in blocks that stay in the first-level cache.

   -DFORM=0: one loop over particles, all substeps of sixteen particles at once.
   -DFORM=1: one fused loop a substep.
   -DFORM=2: one loop an operator, so that few values are alive at a time. */

#include "elementary.h"

#define BLOCK 256
#define SUBSTEPS 4

typedef struct { vec3 normal; vec3 center; float radius, resilience, friction, threshold; } surface_of;
typedef struct {
    vec3 gravity;
    float damping;
    vortex_of vortices[2];
    surface_of surfaces[4]; /* the plane, then the spheres */
    float dt;
} effect;
typedef struct { vec3 p, v; } state;
typedef struct { vec3 w; float c, wave, bow; } spiral_of;

/* What stays the same for a particle all through the frame: its turning rate, and the factors made of it. */
INLINE spiral_of spiral(vec3 axis, float speed, float dt)
{
    vec3 w = mul(unit(axis), speed);
    float angle = length(w) * dt;
    circle at = sincos_of(angle);
    return (spiral_of){w, at.c, sinc_from(angle, at.s), cosinc(angle)};
}

INLINE vec3 turn(vec3 v, spiral_of s, float dt)
{
    vec3 around = mul(cross(s.w, v), s.wave * dt);
    return add(add(mul(v, s.c), around), mul(s.w, dot(s.w, v) * dt * dt * s.bow));
}

INLINE state bounce(state now, float distance, vec3 normal, surface_of s)
{
    int inside = distance < 0.0f;
    vec3 along = mul(normal, dot(now.v, normal));
    vec3 across = sub(now.v, along);
    float slowed = choose(length(now.v) < s.threshold, 0.0f, s.friction);
    vec3 bounced = sub(mul(across, 1.0f - slowed), mul(along, s.resilience));
    vec3 out = sub(now.p, mul(normal, distance * 2.0f));
    return (state){pick(inside, out, now.p), pick(inside, bounced, now.v)};
}

INLINE state plane(state now, surface_of s) { return bounce(now, dot(sub(now.p, s.center), s.normal), s.normal, s); }

INLINE state sphere(state now, surface_of s)
{
    vec3 offset = sub(now.p, s.center);
    float R = length(offset);
    return bounce(now, R - s.radius, mul(offset, choose(R > 0.0f, 1.0f / R, 0.0f)), s);
}

INLINE vec3 drive(vec3 v, spiral_of s, const effect *e)
{
    v = add(v, mul(e->gravity, e->dt));
    v = mul(v, most(1.0f - e->damping * e->dt, 0.0f));
    return turn(v, s, e->dt);
}

INLINE vec3 move(vec3 p, vec3 before, vec3 v, float dt) { return add(p, mul(add(before, v), dt * 0.5f)); }

INLINE state step(state now, spiral_of s, const effect *e)
{
    vec3 before = now.v;
    now.v = drive(now.v, s, e);
    now.p = vortex(now.p, e->dt, e->vortices[0]);
    now.p = vortex(now.p, e->dt, e->vortices[1]);
    now.p = move(now.p, before, now.v, e->dt);
    now = plane(now, e->surfaces[0]);
    now = sphere(now, e->surfaces[1]);
    now = sphere(now, e->surfaces[2]);
    return sphere(now, e->surfaces[3]);
}

#define P (vec3){px[i], py[i], pz[i]}
#define V (vec3){vx[i], vy[i], vz[i]}
#define A (vec3){ax[i], ay[i], az[i]}
#define S (spiral_of){{wx[i], wy[i], wz[i]}, sc[i], wave[i], bow[i]}
#define PUT(to, from) do { vec3 put_ = (from); to##x[i] = put_.x; to##y[i] = put_.y; to##z[i] = put_.z; } while (0)
#define EACH _Pragma("omp simd") for (long i = 0; i < BLOCK; i++)

INLINE void block(float *restrict px, float *restrict py, float *restrict pz, float *restrict vx, float *restrict vy,
                  float *restrict vz, const float *restrict ax, const float *restrict ay, const float *restrict az,
                  const float *restrict speed, const effect *given)
{
    const effect e = *given;
#if FORM == 0
    EACH {
        spiral_of s = spiral(A, speed[i], e.dt);
        state now = {P, V};
#pragma GCC unroll 4
        for (int k = 0; k < SUBSTEPS; k++) now = step(now, s, &e);
        PUT(p, now.p); PUT(v, now.v);
    }
#else
    float wx[BLOCK], wy[BLOCK], wz[BLOCK], sc[BLOCK], wave[BLOCK], bow[BLOCK];
    EACH {
        spiral_of s = spiral(A, speed[i], e.dt);
        PUT(w, s.w);
        sc[i] = s.c; wave[i] = s.wave; bow[i] = s.bow;
    }
    for (int k = 0; k < SUBSTEPS; k++) {
#if FORM == 1
        EACH {
            state now = step((state){P, V}, S, &e);
            PUT(p, now.p); PUT(v, now.v);
        }
#else
        float bx[BLOCK], by[BLOCK], bz[BLOCK];
        EACH { PUT(b, V); PUT(v, drive(V, S, &e)); }
        EACH PUT(p, vortex(P, e.dt, e.vortices[0]));
        EACH PUT(p, vortex(P, e.dt, e.vortices[1]));
        EACH PUT(p, move(P, ((vec3){bx[i], by[i], bz[i]}), V, e.dt));
        EACH { state now = plane((state){P, V}, e.surfaces[0]); PUT(p, now.p); PUT(v, now.v); }
        for (int s = 1; s < 4; s++)
            EACH { state now = sphere((state){P, V}, e.surfaces[s]); PUT(p, now.p); PUT(v, now.v); }
#endif
    }
#endif
}

/* columns: position, velocity, spiral axis (three arrays each), speed; whole blocks of particles */
void run(float **c, long first, long last, const effect *e)
{
    for (long i = first; i < last; i += BLOCK)
        block(c[0] + i, c[1] + i, c[2] + i, c[3] + i, c[4] + i, c[5] + i, c[6] + i, c[7] + i, c[8] + i, c[9] + i, e);
}
