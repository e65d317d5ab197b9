// Probes: shared functions as words in, words out, so that one text calls them on the device and on
// the host.

// C and C++: typedefs, and the names of the shared maths.
// NOLINTBEGIN(modernize-use-using, readability-identifier-naming)

#define PROBE_INPUTS 36
#define PROBE_OUTPUTS 24

typedef struct {
    Real w[PROBE_INPUTS];
} ProbeIn;
typedef struct {
    Real w[PROBE_OUTPUTS];
} ProbeOut;

#ifdef __OPENCL_C_VERSION__
#define wordInt(x) asInt(x)
#define wordUint(x) asUint(x)
#define intWord(x) asReal(x)
#else
FN Int wordInt(Real x) { return std::bit_cast<Int>(x); }
FN Uint wordUint(Real x) { return std::bit_cast<Uint>(x); }
FN Real intWord(Uint x) { return std::bit_cast<Real>(x); }
#endif

FN vec2 in2(ProbeIn i, int at) { return v2(i.w[at], i.w[at + 1]); }
FN vec3 in3(ProbeIn i, int at) { return v3(i.w[at], i.w[at + 1], i.w[at + 2]); }
FN Interface in_interface(ProbeIn i, int at) {
    Interface f;
    f.eta = i.w[at];
    f.inv_eta = i.w[at + 1];
    f.m_high = i.w[at + 2];
    f.m_low = i.w[at + 3];
    return f;
}

FN ProbeOut no_output(void) {
    ProbeOut o;
    for (int k = 0; k < PROBE_OUTPUTS; k++)
        o.w[k] = R(0.);
    return o;
}
FN ProbeOut put1(ProbeOut o, int at, Real x) {
    o.w[at] = x;
    return o;
}
FN ProbeOut put2(ProbeOut o, int at, vec2 v) { return put1(put1(o, at, v.x), at + 1, v.y); }
FN ProbeOut put3(ProbeOut o, int at, vec3 v) {
    return put1(put1(put1(o, at, v.x), at + 1, v.y), at + 2, v.z);
}
FN ProbeOut out1(Real x) { return put1(no_output(), 0, x); }
FN ProbeOut out2(vec2 v) { return put2(no_output(), 0, v); }
FN ProbeOut out3(vec3 v) { return put3(no_output(), 0, v); }
FN Real mask_word(Mask m) { return sel(m, R(1.), R(0.)); }

// Records from words, by the lists of types.h.
#define IN_float(x) (x)
#define IN_int(x) wordInt(x)
#define RECORD_INPUT(Struct, FIELDS, words)                                                        \
    FN Struct in_##Struct(ProbeIn i, int at) {                                                     \
        Struct s;                                                                                  \
        FIELDS(TAKE_FIELD)                                                                         \
        return s;                                                                                  \
    }
#define TAKE_FIELD(type, name) s.name = IN_##type(i.w[at++]);
RECORDS(RECORD_INPUT)
MADE_OF_RECORDS(RECORD_INPUT)
RECORD_INPUT(Camera, CAMERA_FIELDS, 30)

// NOLINTEND(modernize-use-using, readability-identifier-naming)
