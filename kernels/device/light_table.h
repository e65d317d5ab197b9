// Picking a row of the light table in proportion to its power.

/// Alias method (Walker 1977; Vose 1991) on integers: x picks the row, y keeps it or takes its
/// alias.
FN Int pick_light(global const LightAlias* table, int count, Uint x, Uint y) {
    Int row = asInt(mulHigh(x, (Uint)(uint)count));
    Uint threshold = asUint(gather((global const float*)table, row * 2));
    Int alias = asInt(gather((global const float*)table, row * 2 + 1));
    return sel(y < threshold, row, alias);
}
