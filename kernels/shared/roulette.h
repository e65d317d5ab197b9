// Russian roulette.

typedef struct {
    Mask alive;
    Real scale; // 1 / probability of going on
} Roulette;

/// Russian roulette on the throughput, undone for the radiance scaling of refraction; survives with
/// at most 0.95, unbiased.
FN Roulette russian_roulette(vec3 throughput, Real eta_scale, Real u) {
    Real q = minR(max_component(throughput) * eta_scale * eta_scale, R(0.95));
    Roulette r;
    r.alive = u < q;
    r.scale = R(1.) / sel(r.alive, q, R(1.));
    return r;
}
