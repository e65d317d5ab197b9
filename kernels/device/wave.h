// Which pixel and sample of a wave a slot of the pool stands for.
//
// The samples of a pixel lie side by side, and the pixels of a block in Morton order, so the rays
// of a packet start as close together as they can: of 16 samples, in one pixel.
#ifndef PARHELION_WAVE_H
#define PARHELION_WAVE_H

#if BLOCK_SIDE != 4
#error "the order of pixels is written for blocks of 4 x 4"
#endif

#define BLOCK_PARTS (BLOCK_PIXELS / LANES)

/// The block that is the n-th of its wave.
FN WaveBlock wave_block(global const WaveBlock* blocks, int n) {
    return AT(global const WaveBlock, blocks, n);
}

/// The place in its wave of a packet's block: a block's slots are whole packets.
FN int slot_block(WaveParams w, int slot) { return slot / (BLOCK_PIXELS * w.sample_count); }

typedef struct {
    Int x, y;   // of the pixel in its block
    Int sample; // its number
} SlotSample;

/// What the slots from `slot` on stand for, whose block's samples begin with first_sample.
FN SlotSample slot_sample(WaveParams w, int first_sample, int slot) {
    int in_block = slot % (BLOCK_PIXELS * w.sample_count);
    Int pixel = (Int)(in_block / w.sample_count);
    Int sample = (Int)(in_block % w.sample_count) + LANE_INDEX;
    for (int lanes = LANES - 1; lanes > 0; lanes -= w.sample_count) {
        Mask next_pixel = sample >= w.sample_count;
        pixel = sel(next_pixel, pixel + 1, pixel);
        sample = sel(next_pixel, sample - w.sample_count, sample);
    }
    SlotSample s;
    s.x = (pixel & 1) | ((pixel >> 1) & 2);
    s.y = ((pixel >> 1) & 1) | ((pixel >> 2) & 2);
    s.sample = first_sample + sample;
    return s;
}

/// The slots, from the first of their block on, of one sample of a part of the block's pixels, row
/// by row; the inverse of slot_sample.
FN Int part_slots(WaveParams w, int part, int sample) {
    Int pixel = (Int)(part * LANES) + LANE_INDEX, x = BLOCK_COLUMN(pixel), y = BLOCK_ROW(pixel);
    Int place = (x & 1) | ((y & 1) << 1) | ((x & 2) << 1) | ((y & 2) << 2);
    return place * w.sample_count + sample;
}

#endif
