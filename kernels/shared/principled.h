// What Burley's principled materials are made of (Burley 2012, "Physically-Based Shading at
// Disney"; 2015, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering"), with
// the decisions of Mitsuba 3 where they leave some. materials.h says where their numbers live.
//
// Directions are local, on the upper side. What names of textures round to a little more than 1 is
// not more.

/// What a share leaves of 1.
FN Real rest_of(Real share) { return maxR(R(1.) - share, R(0.)); }

FN vec3 mix3(vec3 a, vec3 b, Real share) { return add3(a, scale3(sub3(b, a), share)); }

/// Roughness along both tangents: the square of Burley's, stretched; never less than Mitsuba's.
#define LEAST_PRINCIPLED_ALPHA .001
FN vec2 principled_alphas(Real roughness, Real anisotropic) {
    Real even = roughness * roughness, aspect = R(1.);
    if (HAS(anisotropy)) aspect = sqrt_nonnegative(R(1.) - R(.9) * anisotropic);
    return v2(maxR(even / aspect, R(LEAST_PRINCIPLED_ALPHA)),
              maxR(even * aspect, R(LEAST_PRINCIPLED_ALPHA)));
}

/// The interface of relative index eta seen from outside, or from within: eta^2 - 1 in two parts,
/// and what that is of the inverse index, -(eta^2 - 1) / eta^2.
FN Interface interface_of_index(Real eta, Mask outside) {
    Real squared = eta * eta, squared_low = fmaR(eta, eta, -squared);
    TwoReal m = two_difference(squared, R(1.));
    m = two_quick_sum(m.high, m.low + squared_low);
    Interface i;
    i.eta = eta, i.inv_eta = R(1.) / eta;
    if (HAS(spec_trans)) {
        Real inside = -m.high / squared;
        Real remainder = fmaR(-inside, squared, -m.high) - (inside * squared_low + m.low);
        TwoReal n = two_quick_sum(inside, remainder / squared);
        Real inverse = i.inv_eta;
        i.eta = sel(outside, eta, inverse), i.inv_eta = sel(outside, inverse, eta);
        m.high = sel(outside, m.high, n.high), m.low = sel(outside, m.low, n.low);
    }
    i.m_high = m.high, i.m_low = m.low;
    return i;
}

/// (1 - c)^5 (Schlick 1994).
FN Real schlick_weight(Real c) {
    Real rest = rest_of(c);
    return square(square(rest)) * rest;
}
/// The mean of it over what a matte surface sends to a viewer.
#define SCHLICK_MEAN R(.0476190476190476) // 1 / 21

/// Its cosine is the one in the thinner medium.
FN Real schlick_weight_at(Real c, Fresnel f, Interface face) {
    return schlick_weight(sel(face.eta > R(1.), c, f.g * face.inv_eta));
}

/// What is reflected head-on.
FN Real head_on_reflectance(Real eta) { return square((eta - R(1.)) / (eta + R(1.))); }

/// The hue of a colour: as bright as white.
FN vec3 hue_of(vec3 c) {
    Real luminance = R(0.212671) * c.x + R(0.715160) * c.y + R(0.072169) * c.z;
    Mask some = luminance > R(0.);
    return sel3(some, scale3(c, R(1.) / sel(some, luminance, R(1.))), splat3(R(1.)));
}

/// Between dielectric and metal: the dielectric's reflectance by Fresnel, of which spec_tint takes
/// a share to the hue of the base by Schlick.
FN vec3 tinted_fresnel(Material m, Fresnel f, Real schlick, vec3 hue, Real eta) {
    vec3 tinted = mix3(scale3(hue, head_on_reflectance(eta)), splat3(R(1.)), schlick);
    return add3(splat3(rest_of(SPEC_TINT(m)) * f.reflectance), scale3(tinted, SPEC_TINT(m)));
}

/// About what a mirroring lobe sends on of what it reflects head-on, for choosing among lobes: half
/// of what Schlick says of the viewer's cosine, as rough facets lean. Never 0.
FN Real likely_reflectance(Real head_on, Real cosine) {
    return head_on + (R(1.) - head_on) * (.5f * schlick_weight(cosine) + SCHLICK_MEAN);
}

/// f cos(wi) of what is spread without a share of it taken away: Burley's retroreflecting base, by
/// `flatness` his thin layer of scattering (2015, after Hanrahan and Krueger 1993), and sheen by
/// `sheen` of it. `half_cosine` is that between a direction and the half vector.
FN vec3 spread_by_base(Material m, vec3 hue, Real sheen, Real out, Real in, Real half_cosine) {
    Real o = schlick_weight(out), i = schlick_weight(in);
    Real retro = 2.f * m.alpha_u * square(half_cosine);
    Real rough = (R(1.) - .5f * o) * (R(1.) - .5f * i) + retro * (o + i + o * i * (retro - R(1.)));
    Real grazing = .5f * retro - R(1.);
    Real layer = (R(1.) + grazing * o) * (R(1.) + grazing * i);
    Real flat = R(1.25) * (layer * (R(1.) / (out + in) - .5f) + .5f);
    Real matte = rest_of(FLATNESS(m)) * rough + FLATNESS(m) * flat;
    vec3 f = scale3(material_reflectance(m), matte * R(INV_PI));
    if (HAS(sheen)) {
        vec3 tint = mix3(splat3(R(1.)), hue, SHEEN_TINT(m));
        f = add3(f, scale3(tint, sheen * schlick_weight(half_cosine)));
    }
    return scale3(f, in);
}
/// The most that sheen of 1 sends on, at grazing angles.
#define SHEEN_MOST R(.088)

// The clear coat: GTR1 (Burley 2012), which has longer tails than GGX.

FN Real clearcoat_alpha(Material m) { return R(.1) - R(.099) * CLEARCOAT_GLOSS(m); }

/// Its density of normals times their cosine is a density of directions.
FN Real gtr1_d(vec3 h, Real alpha) {
    Real squared = alpha * alpha;
    Real under = (h.x * h.x + h.y * h.y) + squared * (h.z * h.z);
    return R(INV_PI) * (R(1.) - squared) / (-log_unit(squared) * under);
}

FN vec3 gtr1_sample(Real alpha, vec2 u) {
    Real squared = alpha * alpha;
    Real power = exp_negative(log_unit(squared) * (R(1.) - u.y));
    Real scale = R(1.) / (R(1.) - squared);
    Real sine = sqrt_nonnegative((power - squared) * scale);
    SinCos phi = sincos_turns(u.x);
    return v3(sine * phi.cosine, sine * phi.sine, sqrt_nonnegative((R(1.) - power) * scale));
}

/// f cos(wi): 4 cos cos is not divided by, as in Mitsuba 3.
FN Real clearcoat_value(Material m, vec3 o, vec3 i, vec3 h, Real schlick) {
    Real fresnel = R(.04) + R(.96) * schlick,
         shadowed = ggx_g1(o, R(.25), R(.25)) * ggx_g1(i, R(.25), R(.25));
    return .25f * CLEARCOAT(m) * fresnel * gtr1_d(h, clearcoat_alpha(m)) * shadowed * i.z;
}
/// The most that a clear coat of 1 sends on, head-on.
#define CLEARCOAT_MOST R(.04)
