/* Snow, as snow.json has it, one step a frame: half a turn of the velocity about each particle's own axis with the way
   that it makes, the gust's two vortices around each other, the other half turn; then the plane: a particle that
   would meet it is left as it was (`met` becomes 1). `tail` takes the place at which the shutter opens.

   -DDRAW=1 draws each particle's turning rate from Philox in every frame, as graphfx does, which keeps nothing that
   it can find again; -DDRAW=0 reads it from a column.
   -DFORM=1: one fused loop. -DFORM=2: one loop an operator. */

#include "elementary.h"

#define BLOCK 256

typedef struct {
    vortex_of left, right;
    vec3 point, normal;
    float slowest, fastest;
    float dt, half, begin, end, opening;
    uint32_t key[2];
} effect;
typedef struct { vec3 p, v; } state;
typedef struct { float c, wave, bow, curl; } turning;

INLINE float uniform_draw(uint64_t id, uint32_t k0, uint32_t k1)
{
    uint32_t a = (uint32_t)id, b = (uint32_t)(id >> 32), c = 0, d = 0;
#pragma GCC unroll 10
    for (int turn = 0; turn < 10; turn++) {
        uint64_t first = (uint64_t)a * 0xD2511F53u, second = (uint64_t)c * 0xCD9E8D57u;
        a = (uint32_t)(second >> 32) ^ b ^ k0;
        c = (uint32_t)(first >> 32) ^ d ^ k1;
        b = (uint32_t)second;
        d = (uint32_t)first;
        k0 += 0x9E3779B9u;
        k1 += 0xBB67AE85u;
    }
    return (float)(int32_t)(a >> 8) * 0x1p-24f;
}

INLINE turning turning_of(vec3 w, float dt)
{
    float angle = length(w) * dt;
    circle at = sincos_of(angle);
    float wave = sinc_from(angle, at.s);
    return (turning){at.c, wave, cosinc(angle), sin3(angle, wave)};
}

INLINE state spin(state now, vec3 w, float dt, turning t)
{
    vec3 turned = mul(cross(w, now.v), dt);
    vec3 kept = mul(w, dot(w, now.v) * dt * dt);
    vec3 way = add(add(mul(now.v, t.wave), mul(turned, t.bow)), mul(kept, t.curl));
    vec3 velocity = add(add(mul(now.v, t.c), mul(turned, t.wave)), mul(kept, t.bow));
    return (state){add(now.p, mul(way, dt)), velocity};
}

INLINE vec3 capture(vec3 tail, vec3 first, vec3 last, float begin, float end, float opening)
{
    float share = choose(end > begin, (opening - begin) / (end - begin), 0.0f);
    return pick((begin <= opening) & (opening <= end), add(first, mul(sub(last, first), share)), tail);
}

#define AT(c) (vec3){c##x[i], c##y[i], c##z[i]}
#define PUT(to, from) do { vec3 put_ = (from); to##x[i] = put_.x; to##y[i] = put_.y; to##z[i] = put_.z; } while (0)
#define EACH _Pragma("omp simd") for (long i = 0; i < BLOCK; i++)
#define ROOM(c) float c##x[BLOCK], c##y[BLOCK], c##z[BLOCK]

INLINE void block(float *restrict px, float *restrict py, float *restrict pz, float *restrict vx, float *restrict vy,
                  float *restrict vz, const float *restrict ax, const float *restrict ay, const float *restrict az,
                  float *restrict tx, float *restrict ty, float *restrict tz, const float *restrict speeds,
                  const uint64_t *restrict ids, uint8_t *restrict met, const effect *given)
{
    const effect e = *given;
    float speed[BLOCK];
    if (DRAW) {
        EACH speed[i] = e.slowest + (e.fastest - e.slowest) * uniform_draw(ids[i], e.key[0], e.key[1]);
    } else {
        EACH speed[i] = speeds[i];
    }
#if FORM == 1
    EACH {
        vec3 w = mul(unit(AT(a)), speed[i]), before = AT(p);
        turning t = turning_of(w, e.half);
        state now = spin((state){before, AT(v)}, w, e.half, t);
        now.p = vortex(now.p, e.half, e.left);
        now.p = vortex(now.p, e.dt, e.right);
        now.p = vortex(now.p, e.half, e.left);
        now = spin(now, w, e.half, t);
        int inside = dot(sub(now.p, e.point), e.normal) < 0.0f;
        met[i] = (uint8_t)(met[i] | inside);
        PUT(t, pick(inside, AT(t), capture(before, before, now.p, e.begin, e.end, e.opening)));
        PUT(p, pick(inside, before, now.p)); PUT(v, pick(inside, AT(v), now.v));
    }
#else
    ROOM(w); ROOM(q); ROOM(u);
    float tc[BLOCK], wave[BLOCK], bow[BLOCK], curl[BLOCK];
    EACH {
        vec3 w = mul(unit(AT(a)), speed[i]);
        turning t = turning_of(w, e.half);
        PUT(w, w);
        tc[i] = t.c; wave[i] = t.wave; bow[i] = t.bow; curl[i] = t.curl;
        state now = spin((state){AT(p), AT(v)}, w, e.half, t);
        PUT(q, now.p); PUT(u, now.v);
    }
    EACH PUT(q, vortex(AT(q), e.half, e.left));
    EACH PUT(q, vortex(AT(q), e.dt, e.right));
    EACH PUT(q, vortex(AT(q), e.half, e.left));
    EACH {
        state now = spin((state){AT(q), AT(u)}, AT(w), e.half, ((turning){tc[i], wave[i], bow[i], curl[i]}));
        int inside = dot(sub(now.p, e.point), e.normal) < 0.0f;
        met[i] = (uint8_t)(met[i] | inside);
        vec3 before = AT(p);
        PUT(t, pick(inside, AT(t), capture(before, before, now.p, e.begin, e.end, e.opening)));
        PUT(p, pick(inside, before, now.p)); PUT(v, pick(inside, AT(v), now.v));
    }
#endif
}

/* columns: position, velocity, spiral axis, tail (three arrays each), turning rate, id, met; whole blocks of particles */
void run(void **columns, long first, long last, const effect *e)
{
    float **c = (float **)columns;
    for (long i = first; i < last; i += BLOCK)
        block(c[0] + i, c[1] + i, c[2] + i, c[3] + i, c[4] + i, c[5] + i, c[6] + i, c[7] + i, c[8] + i, c[9] + i, c[10] + i,
              c[11] + i, c[12] + i, (const uint64_t *)columns[13] + i, (uint8_t *)columns[14] + i, e);
}
