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

    /// Rows to take at a time: whole blocks of 16, as EXR's ZIP compresses them, and no more than
    /// 16 MB of values if there are several.
    int band_rows() const {
        constexpr std::size_t most = 256, values = 1 << 22, block = 16;
        const std::size_t of_block =
            block * frame().width * std::max<std::size_t>(4, frame().channels.size());
        return static_cast<int>(
            std::min(most, std::max<std::size_t>(1, values / of_block) * block));
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
