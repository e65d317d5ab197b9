// Probe kernel: runs one of the PROBES that stand above it over arrays of words.

#define PROBE_CHUNK 256

#define PROBE(name, inputs, outputs) number_##name,
enum ProbeNumber { PROBES probe_count };
#undef PROBE

/// Reads: PROBE_INPUTS arrays of `count` words. Writes: PROBE_OUTPUTS arrays of `count` words. A
/// work-item does a chunk.
kernel void probe(global const float* in, global float* out, int count, int which) {
    int first = get_global_id(0) * PROBE_CHUNK;
    for (int at = first; at < min(first + PROBE_CHUNK, count); at += LANES) {
        ProbeIn i;
        for (int k = 0; k < PROBE_INPUTS; k++)
            i.w[k] = LOAD_REAL(in + (long)k * count + at);
        ProbeOut o = no_output();
#define PROBE(name, inputs, outputs)                                                               \
    if (which == number_##name) o = probe_##name(i);
        PROBES
        for (int k = 0; k < PROBE_OUTPUTS; k++)
            STORE_REAL(out + (long)k * count + at, o.w[k]);
    }
}
