// Fresnel reflectance and refraction, in forms that lose no digits at eta near 1, at grazing and at
// the critical angle.

/// A dielectric interface seen from the side of the incident direction.
/// eta = index beyond / index on this side; m = eta^2 - 1 = m_high + m_low.
typedef struct {
    Real eta, inv_eta, m_high, m_low;
} Interface;

typedef struct {
    Real reflectance;   // unpolarised; 1 on total internal reflection
    Real transmittance; // 1 - reflectance, without the subtraction
    Real g;             // eta * cosine beyond the interface; 0 on total internal reflection
} Fresnel;

/// Unpolarised dielectric Fresnel for the cosine c >= 0 on this side.
/// With g = sqrt(eta^2 - 1 + c^2): r_s = -m/(c+g)^2, r_p = m((eta^2+1)c^2-1)/(eta^2 c+g)^2. The sum
/// under the root is taken in two parts, which puts every direction on the right side of the
/// critical angle.
FN Fresnel fresnel_dielectric(Real c, Interface i) {
    Real p = c * c;
    Real g_squared = (p + i.m_high) + (fmaR(c, c, -p) + i.m_low);
    Mask transmits = g_squared > R(0.);
    Real g = sqrtR(sel(transmits, g_squared, R(0.)));
    Real eta_squared = i.eta * i.eta;
    // (c + g)^2 and (eta^2 c + g)^2 from g^2, so that rounding never lifts a reflectance above 1.
    // Grazing is total reflection, with or without an interface: the mirrored direction is the one
    // straight on.
    Real s_squared = sel(transmits, g_squared + c * (c + 2.f * g), R(1.));
    Real q = eta_squared * c;
    Real q_squared = sel(transmits, g_squared + q * (q + 2.f * g), R(1.));
    Real r_s = i.m_high / s_squared;
    // (eta^2 + 1) c^2 - 1 = g^2 - eta^2 sin^2: the second form keeps its digits where the critical
    // angle is near Brewster's.
    Real steep = g_squared - eta_squared * ((R(1.) - c) * (R(1.) + c));
    Real r_p = i.m_high * sel(p > R(.5), steep, (eta_squared + 1.f) * p - 1.f) / q_squared;
    Fresnel f;
    f.reflectance = sel(transmits, .5f * (r_s * r_s + r_p * r_p), R(1.));
    f.transmittance =
        sel(transmits, 2.f * c * g * (R(1.) / s_squared + eta_squared / q_squared), R(0.));
    f.g = g;
    return f;
}

/// Refracts the unit direction w (pointing away from the surface, on the side of the unit normal n:
/// dot(w, n) = c > 0) through the interface; g from fresnel_dielectric. The zero vector on total
/// internal reflection. t = -w/eta - n*(g - c)/eta with g - c = m/(c+g): no cancellation.
FN vec3 refract_about(vec3 w, vec3 n, Real c, Real g, Interface i) {
    Mask transmits = g > R(0.);
    Real along = i.m_high * i.inv_eta / sel(transmits, c + g, R(1.));
    vec3 t = neg3(add3(scale3(w, i.inv_eta), scale3(n, along)));
    return sel3(transmits, t, splat3(R(0.)));
}

/// The same about the normal (0, 0, 1), for w on either side of it.
FN vec3 refract_local_with(vec3 w, Real g, Interface i) {
    vec3 t = v3(-w.x * i.inv_eta, -w.y * i.inv_eta, copysignR(g * i.inv_eta, -w.z));
    return sel3(g > R(0.), t, splat3(R(0.)));
}

/// Refraction in the tangent frame: the normal is (0, 0, 1) and `w` may lie on either side; from
/// below the caller gives the interface with its two indices swapped, and z flips. The zero vector
/// on total internal reflection.
FN vec3 refract_local(vec3 w, Interface i) {
    return refract_local_with(w, fresnel_dielectric(absR(w.z), i).g, i);
}

/// Unpolarised conductor Fresnel, one wavelength; eta + i k relative to the side of incidence, c
/// the cosine. Written with a + i b = sqrt((eta + i k)^2 - sin^2): r_s = (c - a - i b)/(c + a + i
/// b), R_p = R_s |(a + i b) c - s^2|^2/|(a + i b) c + s^2|^2 = R_s (p - q)/(p + q), whose mean with
/// R_s is R_s p/(p + q).
FN Real fresnel_conductor(Real c, Real eta, Real k) {
    Real c_squared = c * c;
    Real s_squared = (R(1.) - c) * (R(1.) + c);
    Real contrast = (eta - 1.f) * (eta + 1.f) - k * k; // eta^2 - k^2 - 1
    // eta^2 - k^2 - sin^2: without the 1 where an index below 1 and a cosine near it would cancel.
    Real difference = sel(c_squared > R(.5), (eta * eta - k * k) - s_squared, contrast + c_squared);
    Real product = 2.f * eta * k;
    Real modulus = sqrtR(difference * difference + product * product); // a^2 + b^2
    // The larger of a^2, b^2 by a sum, the smaller by a quotient: (a b)^2 = (eta k)^2.
    Real large = .5f * (modulus + absR(difference));
    Real half_product = .5f * product;
    Real small =
        sel(large > R(0.), half_product * half_product / sel(large > R(0.), large, R(1.)), R(0.));
    Real a_squared = sel(difference > R(0.), large, small);
    Real a = sqrtR(a_squared);
    Real b_squared = sel(difference > R(0.), small, large);
    Real two_ac = 2.f * a * c;
    Real s_sum = modulus + c_squared;
    // (a - c)^2 + b^2 is s_sum - two_ac, which cancels where little is reflected; there a - c =
    // (a^2 - c^2)/(a + c), and a^2 - c^2 = contrast + b^2.
    Real a_plus_c_squared = square(a + c);
    Mask faint = two_ac > .5f * s_sum;
    Real s_faint = square(contrast + b_squared) + b_squared * a_plus_c_squared;
    Real p_sum = c_squared * modulus + s_squared * s_squared;
    Real over = sel(faint, s_faint, s_sum - two_ac) * p_sum;
    Real under =
        sel(faint, a_plus_c_squared, R(1.)) * (s_sum + two_ac) * (p_sum + two_ac * s_squared);
    return sel(under > R(0.), over / under, R(1.));
}

FN vec3 fresnel_conductor_rgb(Real c, vec3 eta, vec3 k) {
    return v3(fresnel_conductor(c, eta.x, k.x), fresnel_conductor(c, eta.y, k.y),
              fresnel_conductor(c, eta.z, k.z));
}
