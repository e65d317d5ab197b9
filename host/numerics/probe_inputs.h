// Input words for probes, random and nasty, by one letter a value:
//
//   r any float, also NaN and infinite   f any finite float       u [0, 1), the device's grid    c
//   [0, 1] s 0 or 1e-4 .. 1e4                   a roughness 1e-4 .. 1    b 32 random bits d unit
//   vector (3)    p point (3)     i interface (4)          m material (16)    l light (16) g
//   primitive (11)     v vertex (15)   k camera (29)
#pragma once

#include "host/numerics/measure.h"
#include "host/numerics/principled_cases.h"

#include <bit>
#include <functional>
#include <map>
#include <stdexcept>
#include <vector>

namespace parhelion::numerics {

using Words = std::vector<float>;

class ProbeInputs {
public:
    explicit ProbeInputs(std::uint64_t seed) : random_(seed) {}

    /// One set of words for a string of letters.
    Words words(const std::string& letters) {
        words_.clear();
        for (char letter : letters)
            value(letter);
        return words_;
    }

private:
    bool one_in(unsigned n) { return random_.bits() % n == 0; }
    void put(double x) { words_.push_back(static_cast<float>(x)); }
    void put_int(std::uint32_t x) { words_.push_back(std::bit_cast<float>(x)); }
    void put(const f32::vec3& v) { words_.insert(words_.end(), {v.x, v.y, v.z}); }
    void values(const char* letters) {
        for (; *letters; letters++)
            value(*letters);
    }

    void value(char letter) {
        switch (letter) {
        case 'r':
            return real(true);
        case 'f':
            return real(false);
        case 'u':
            return put(one_in(16) ? pick({0, 0x1p-24, 1 - 0x1p-24, 0.125, 0.25, 0.5, 0.75})
                                  : random_.unit());
        case 'c':
            return put(one_in(16) ? pick({0, 1, 1e-7, 1 - 0x1p-24, 1e-40}) : random_.unit());
        case 's':
            return put(one_in(32) ? 0 : random_.log_between(1e-4, 1e4));
        case 'a':
            return put(one_in(16) ? 1 : random_.log_between(1e-4, 1));
        case 'b':
            return put_int(random_.bits());
        case 'd':
            return direction();
        case 'p':
            return point();
        case 'i':
            return interface();
        case 'm':
            return material();
        case 'l':
            return light();
        case 'g':
            return primitive();
        case 'v':
            values("dddfufufu");
            words_.back() = 0;
            return;
        case 'k':
            return camera();
        default:
            throw std::logic_error("no such letter");
        }
    }

    double pick(std::initializer_list<double> from) {
        return from.begin()[random_.bits() % from.size()];
    }

    void real(bool wild) {
        float x = static_cast<float>(random_.between(-10, 10));
        if (one_in(4)) x = std::bit_cast<float>(random_.bits());
        if (one_in(8))
            x = static_cast<float>(
                pick({0, -0., 1, -1, 0x1p-126, -0x1p-149, 1e-40, 3.4028234e38, -1e-20}));
        if (one_in(16)) x = static_cast<float>(pick({INFINITY, -INFINITY, NAN}));
        if (!wild && !std::isfinite(x)) x = 1;
        words_.push_back(x);
    }

    void direction() {
        f32::vec3 v = random_.direction<F32>();
        if (one_in(8)) v = vec<F32>(v.x, v.y, v.z * 1e-6), v = f32::normalize3(v); // grazing
        if (one_in(16)) v = vec<F32>(v.x * 1e-5, v.y * 1e-5, v.z), v = f32::normalize3(v);
        if (one_in(16)) {
            float s = static_cast<float>(random_.sign());
            unsigned axis = random_.bits() % 3;
            v = {axis == 0 ? s : 0.f, axis == 1 ? s : -0.f, axis == 2 ? s : 0.f};
        }
        put(v);
    }

    void point() {
        f32::vec3 v = random_.point<F32>(10);
        if (one_in(16)) v = f32::scale3(v, static_cast<float>(pick({1e5, 1e-6, 1e12, 1e-20})));
        for (float* x : {&v.x, &v.y, &v.z})
            if (one_in(16)) *x = static_cast<float>(pick({0, -0., 1, 0x1p-149}));
        put(v);
    }

    void interface() {
        double eta =
            one_in(8) ? pick({1, 1 + 1e-6, 1 - 1e-6, 1.5, 1 / 1.5}) : random_.log_between(0.3, 3);
        f32::Interface i = interface_of<F32>(eta);
        words_.insert(words_.end(), {i.eta, i.inv_eta, i.m_high, i.m_low});
    }

    void material() {
        std::uint32_t kind = random_.bits() % material_kind_count;
        put_int(kind);
        values("cccccc");
        if (is_principled_kind(static_cast<int>(kind))) {
            double eta = one_in(8) ? 1 : random_.log_between(0.3, 3);
            words_.push_back(static_cast<float>(eta));
            values("ccccccc");
            put_int(random_.bits() & 1);
            return;
        }
        if ((OPAQUE_MATERIALS >> kind) & 1) {
            values("ssssss");
        } else {
            double eta = one_in(8) ? 1 : random_.log_between(0.3, 3);
            f32::Interface outside = interface_of<F32>(eta), inside = interface_of<F32>(1 / eta);
            words_.insert(words_.end(), {outside.eta, inside.eta, outside.m_high, outside.m_low,
                                         inside.m_high, inside.m_low});
        }
        values("aa");
        if (one_in(2)) words_.back() = words_[words_.size() - 2];
        std::size_t alpha_u = words_.size() - 2, variant = words_.size() - 5;
        if (kind == material_phong)
            words_[alpha_u] = static_cast<float>(one_in(8) ? 0 : random_.log_between(1e-2, 1e8));
        if (kind == material_ward) words_[variant] = static_cast<float>(pick({0, 1, 2}));
        put_int(random_.bits() & 1);
    }

    void light() {
        std::uint32_t kind = random_.bits() % emitter_kind_count;
        put_int(kind);
        value('p');
        double extra = random_.sign(), beam = random_.between(0, 1),
               cutoff = beam + random_.between(1e-3, 0.5);
        switch (kind) {
        case emitter_area_sphere:
            values("srrrrr");
            break;
        case emitter_spot:
            value('d');
            put(std::cos(cutoff)), put(cutoff), put(1 / (cutoff - beam));
            extra = std::cos(beam);
            break;
        case emitter_area_cylinder:
            values("psrr");
            break;
        case emitter_projector:
            values("dp");
            break;
        case emitter_directional:
            values("drrr");
            break;
        default:
            values("pp");
            break;
        }
        values("sss");
        put(random_.between(1e-3, 1)), put(random_.log_between(1e-4, 1e4)), put(extra);
    }

    void primitive() {
        std::uint32_t kind = random_.bits() % geometry_kind_count;
        value('p');
        values(kind == geometry_sphere ? "dd" : "pp");
        value('s');
        put_int(kind | (random_.bits() & (PRIMITIVE_FLIPPED | PRIMITIVE_NORMALS | PRIMITIVE_UVS)));
    }

    void camera() {
        values("pddd");
        for (std::size_t k = words_.size() - 6; k < words_.size(); k++)
            words_[k] *= 1e-3f;
        values("pp");
        put(random_.log_between(1e-4, 1)), put(random_.log_between(1, 1e5)),
            put(random_.log_between(1e-2, 1e2));
        put(random_.between(0, 1e3)), put(random_.between(0, 1e3));
        values("sup"), put(random_.unit());
        put(one_in(2) ? 1 : 0); // parallel
    }

    Random random_;
    Words words_;
};

} // namespace parhelion::numerics
