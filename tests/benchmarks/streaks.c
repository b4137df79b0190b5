/* The textbook renderer of streaks: tiles, a buffer of fragments, insertion sort per pixel, exact order.

   Streaks come in screen space, one array a quantity, n values each: x0 y0 z0 x1 y1 z1 radius opacity red green blue.
   They are sorted by their nearest depth, so that most fragments come nearly in order, and binned into tiles of 16 x 16. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 16, PIXELS = SIZE * SIZE };
enum { X0, Y0, Z0, X1, Y1, Z1, RADIUS, OPACITY, RED, GREEN, BLUE };

static float least(float a, float b) { return a < b ? a : b; }
static float most(float a, float b) { return a > b ? a : b; }

/* Sort by nearest depth: radix, 11 bits a pass, stable. */
void order(float *const *c, long n, uint32_t *rows) {
    uint32_t *keys = malloc(n * 4), *spare_keys = malloc(n * 4), *spare_rows = malloc(n * 4);
    for (long i = 0; i < n; i++) {
        float z = least(c[Z0][i], c[Z1][i]);
        uint32_t bits;
        memcpy(&bits, &z, 4);
        keys[i] = bits >> 31 ? ~bits : bits | 0x80000000u;
        rows[i] = (uint32_t)i;
    }
    for (int shift = 0; shift < 33; shift += 11) {
        long places[2049] = {0};
        for (long i = 0; i < n; i++) places[(keys[i] >> shift & 2047) + 1]++;
        for (int d = 0; d < 2048; d++) places[d + 1] += places[d];
        for (long i = 0; i < n; i++) {
            long place = places[keys[i] >> shift & 2047]++;
            spare_keys[place] = keys[i];
            spare_rows[place] = rows[i];
        }
        memcpy(keys, spare_keys, n * 4);
        memcpy(rows, spare_rows, n * 4);
    }
    free(keys), free(spare_keys), free(spare_rows);
}

/* Count the streaks of rows first ... last - 1 in each tile, or write them to their places. */
void bin(float *const *c, const uint32_t *rows, long first, long last, int across, int down, int64_t *places, uint32_t *members) {
    for (long k = first; k < last; k++) {
        uint32_t i = rows[k];
        float x = c[X0][i], y = c[Y0][i], dx = c[X1][i] - x, dy = c[Y1][i] - y, r = c[RADIUS][i];
        int top = (int)most(floorf((least(y, y + dy) - r) / SIZE), 0), bottom = (int)least(floorf((most(y, y + dy) + r) / SIZE), down - 1);
        for (int row = top; row <= bottom; row++) {
            float a = 0, b = 1;
            if (dy != 0) {
                float u = (row * SIZE - r - y) / dy, v = (row * SIZE + SIZE + r - y) / dy;
                a = most(a, least(u, v)), b = least(b, most(u, v));
            }
            float u = x + a * dx, v = x + b * dx;
            int left = (int)most(floorf((least(u, v) - r) / SIZE), 0), right = (int)least(floorf((most(u, v) + r) / SIZE), across - 1);
            for (int tile = row * across + left; tile <= row * across + right; tile++) {
                if (members) members[places[tile]] = i;
                places[tile]++;
            }
        }
    }
}

typedef struct { float z, opacity, red, green, blue; } Fragment;

/* Render tiles first ... last - 1 into the film, 4 floats a pixel; return the number of fragments. */
long tiles(float *const *c, const int64_t *starts, const uint32_t *members, long first, long last, int across, int width, int height, float *film) {
    long capacity = 64, total = 0;
    Fragment *buffer = malloc(PIXELS * capacity * sizeof(Fragment));
    for (long tile = first; tile < last; tile++) {
        int left = tile % across * SIZE, top = tile / across * SIZE, counts[PIXELS] = {0};
        for (int64_t m = starts[tile]; m < starts[tile + 1]; m++) {
            uint32_t i = members[m];
            float x0 = c[X0][i], y0 = c[Y0][i], z0 = c[Z0][i], dx = c[X1][i] - x0, dy = c[Y1][i] - y0, dz = c[Z1][i] - z0;
            float r = c[RADIUS][i], o = c[OPACITY][i], squared = dx * dx + dy * dy, inverse = squared > 1e-12f ? 1 / squared : 0;
            int ya = (int)most(ceilf(least(y0, y0 + dy) - r - 0.5f), top), yb = (int)least(floorf(most(y0, y0 + dy) + r - 0.5f), top + SIZE - 1);
            for (int y = ya; y <= yb; y++) {
                float down = y + 0.5f - y0, a = 0, b = 1;
                if (dy != 0) {
                    float u = (down - r) / dy, v = (down + r) / dy;
                    a = most(a, least(u, v)), b = least(b, most(u, v));
                }
                float u = x0 + a * dx, v = x0 + b * dx;
                int xa = (int)most(ceilf(least(u, v) - r - 0.5f), left), xb = (int)least(floorf(most(u, v) + r - 0.5f), left + SIZE - 1);
                for (int x = xa; x <= xb; x++) {
                    float over = x + 0.5f - x0, t = least(most((over * dx + down * dy) * inverse, 0), 1);
                    float ex = over - t * dx, ey = down - t * dy, distance = sqrtf(ex * ex + ey * ey);
                    if (distance >= r) continue;
                    int pixel = (y - top) * SIZE + x - left;
                    if (counts[pixel] == capacity) {
                        Fragment *larger = malloc(PIXELS * 2 * capacity * sizeof(Fragment));
                        for (int p = 0; p < PIXELS; p++) memcpy(larger + p * 2 * capacity, buffer + p * capacity, counts[p] * sizeof(Fragment));
                        free(buffer);
                        buffer = larger, capacity *= 2;
                    }
                    Fragment *list = buffer + pixel * capacity;
                    float z = z0 + t * dz;
                    int at = counts[pixel]++;
                    while (at > 0 && list[at - 1].z > z) list[at] = list[at - 1], at--;
                    list[at] = (Fragment){z, o * (1 - distance / r), c[RED][i], c[GREEN][i], c[BLUE][i]};
                    total++;
                }
            }
        }
        for (int pixel = 0; pixel < PIXELS; pixel++) {
            int x = left + pixel % SIZE, y = top + pixel / SIZE;
            if (x >= width || y >= height) continue;
            float through = 1, red = 0, green = 0, blue = 0;
            for (Fragment *f = buffer + pixel * capacity, *end = f + counts[pixel]; f < end; f++) {
                float seen = through * f->opacity;
                red += seen * f->red, green += seen * f->green, blue += seen * f->blue, through -= seen;
            }
            float *out = film + 4 * ((long)y * width + x);
            out[0] = red, out[1] = green, out[2] = blue, out[3] = 1 - through;
        }
    }
    free(buffer);
    return total;
}
