// An image that is made a band of rows at a time, so that no more of it need be in memory.
#pragma once

#include "host/image/image.h"

#include <algorithm>

namespace parhelion {

class ImageRows {
public:
    ImageRows() = default;
    virtual ~ImageRows() = default;
    ImageRows(const ImageRows&) = delete;
    ImageRows& operator=(const ImageRows&) = delete;

    /// The image but for its values: channels have their names alone.
    virtual const Image& frame() const = 0;
    /// `count` rows from `first` on, as an image of their own: of the same channels, in the same
    /// order.
    virtual Image rows(int first, int count) const = 0;

    /// Rows to take at a time: whole blocks of 16, as EXR's ZIP compresses them.
    int band_rows() const {
        constexpr int most = 256, pixels = 1 << 20;
        return std::min(most, std::max(1, pixels / 16 / frame().width) * 16);
    }
};

/// One that is in memory already. It must outlive this.
class WholeImage : public ImageRows {
public:
    explicit WholeImage(const Image& image);

    const Image& frame() const override { return frame_; }
    Image rows(int first, int count) const override;

private:
    const Image& image_;
    Image frame_;
};

} // namespace parhelion
