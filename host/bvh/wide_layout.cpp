// Numbering of nodes and leaves in the order of the tree, and packing of boxes into rows of 16.
#include "host/bvh/wide_layout.h"

#include "host/bvh/leaf_layout.h"
#include "host/parallel.h"

#include <algorithm>
#include <array>

namespace parhelion {
namespace {

constexpr int task_references = 1 << 14; // subtrees of more are tasks of their own

BvhNode empty_node() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    BvhNode node;
    for (int row = 0; row < 6; row++)
        std::fill_n(node.bounds[row], BVH_WIDTH, row % 2 == 0 ? infinity : -infinity);
    std::fill_n(node.child, BVH_WIDTH, 0);
    return node;
}

void write_box(BvhNode& node, int place, const Box& box) {
    for (int axis = 0; axis < 3; axis++) {
        node.bounds[2 * axis][place] = box.low[axis];
        node.bounds[2 * axis + 1][place] = box.high[axis];
    }
}

/// The binary nodes that are the children of a wide one.
struct Children {
    std::array<int, BVH_WIDTH> binary;
    int count = 0;
};

/// A binary tree seen as the wide tree that the plan makes of it.
class Collapsed {
public:
    Collapsed(const BinaryTree& tree, const CollapsePlan& plan) : tree_(tree), plan_(plan) {}

    const BinaryNode& node(int binary) const { return tree_.nodes[std::size_t(binary)]; }
    bool is_leaf(int binary) const { return left_roots(binary, 1) == 0; }
    std::span<const Reference> references(int binary) const {
        return std::span(tree_.references)
            .subspan(std::size_t(node(binary).first), std::size_t(node(binary).count));
    }
    Children children(int binary) const {
        Children children;
        gather_both(binary, BVH_WIDTH, children);
        return children;
    }

private:
    int left_roots(int binary, int roots) const {
        return plan_.choices[std::size_t(binary)].left_roots[std::size_t(roots)];
    }

    /// The binary nodes that stand for a subtree when it may take up to `roots` places.
    void gather(int binary, int roots, Children& children) const {
        while (roots > 1 && left_roots(binary, roots) == 0)
            roots--;
        if (roots == 1)
            children.binary[std::size_t(children.count++)] = binary;
        else
            gather_both(binary, roots, children);
    }

    void gather_both(int binary, int roots, Children& children) const {
        int left = left_roots(binary, roots), first = node(binary).children;
        gather(first, left, children);
        gather(first + 1, roots - left, children);
    }

    const BinaryTree& tree_;
    const CollapsePlan& plan_;
};

/// Calls visit(i, child) for the children that are nodes, large ones in tasks of their own.
template<class Visit>
void for_node_children(const Collapsed& collapsed, const Children& children, const Visit& visit) {
    TaskGroup group;
    for (int i = 0; i < children.count; i++) {
        int child = children.binary[std::size_t(i)];
        if (collapsed.is_leaf(child)) continue;
        if (collapsed.node(child).count > task_references)
            group.run([&visit, i, child] { visit(i, child); });
        else
            visit(i, child);
    }
    group.wait();
}

class Measurer {
public:
    Measurer(const Collapsed& collapsed, const IndexedGeometry& geometry, WideTree& wide)
        : collapsed_(collapsed), geometry_(geometry), wide_(wide) {}

    WideExtent measure_leaf(int binary) const {
        int lines = leaf_lines(collapsed_.references(binary), geometry_);
        wide_.lines_below[std::size_t(binary)] = lines;
        return {.leaves = 1, .leaf_lines = lines};
    }

    /// A walk that goes down into one child leaves the others waiting: children - 1 entries a
    /// level.
    WideExtent measure(int binary) const {
        Children children = collapsed_.children(binary);
        std::array<WideExtent, BVH_WIDTH> below;
        for (int i = 0; i < children.count; i++) {
            int child = children.binary[std::size_t(i)];
            if (collapsed_.is_leaf(child)) below[std::size_t(i)] = measure_leaf(child);
        }
        for_node_children(collapsed_, children,
                          [&](int i, int child) { below[std::size_t(i)] = measure(child); });
        WideExtent extent;
        for (int i = 0; i < children.count; i++) {
            const WideExtent& child = below[std::size_t(i)];
            extent.nodes += child.nodes;
            extent.leaves += child.leaves;
            extent.leaf_lines += child.leaf_lines;
            extent.depth = std::max(extent.depth, child.depth);
            extent.stack_entries = std::max(extent.stack_entries, child.stack_entries);
        }
        extent.nodes++;
        extent.depth++;
        extent.stack_entries += children.count - 1;
        wide_.nodes_below[std::size_t(binary)] = extent.nodes;
        wide_.lines_below[std::size_t(binary)] = extent.leaf_lines;
        return extent;
    }

private:
    const Collapsed& collapsed_;
    const IndexedGeometry& geometry_;
    WideTree& wide_;
};

class Writer {
public:
    Writer(Bvh& bvh, const Collapsed& collapsed, const WideTree& wide,
           const IndexedGeometry& geometry)
        : bvh_(bvh), collapsed_(collapsed), wide_(wide), geometry_(geometry) {}

    /// Writes the subtree of a wide node to the nodes and the lines from `node` and `line` on.
    void write_node(int binary, int node, int line) const {
        Children children = collapsed_.children(binary);
        BvhNode& out = bvh_.nodes[std::size_t(node)] = empty_node();
        std::array<int, BVH_WIDTH> first_node, first_line;
        for (int i = 0; i < children.count; i++) {
            int child = children.binary[std::size_t(i)];
            write_box(out, i, collapsed_.node(child).box);
            if (!collapsed_.is_leaf(child)) continue;
            out.child[i] = write_leaf_at(child, line);
            line += wide_.lines_below[std::size_t(child)];
        }
        node++;
        for (int i = 0; i < children.count; i++) {
            auto child = std::size_t(children.binary[std::size_t(i)]);
            if (collapsed_.is_leaf(int(child))) continue;
            first_node[std::size_t(i)] = out.child[i] = node;
            first_line[std::size_t(i)] = line;
            node += wide_.nodes_below[child];
            line += wide_.lines_below[child];
        }
        for_node_children(collapsed_, children, [&](int i, int child) {
            write_node(child, first_node[std::size_t(i)], first_line[std::size_t(i)]);
        });
    }

    /// Returns the child code.
    int write_leaf_at(int binary, int line) const {
        return write_leaf(bvh_, line, collapsed_.references(binary), geometry_);
    }

private:
    Bvh& bvh_;
    const Collapsed& collapsed_;
    const WideTree& wide_;
    const IndexedGeometry& geometry_;
};

} // namespace

WideTree measure_wide_tree(const BinaryTree& tree, const CollapsePlan& plan,
                           const IndexedGeometry& geometry) {
    Collapsed collapsed(tree, plan);
    WideTree wide{{}, LargeVector<int>(tree.nodes.size()), LargeVector<int>(tree.nodes.size())};
    Measurer measurer(collapsed, geometry, wide);
    wide.extent = collapsed.is_leaf(0) ? measurer.measure_leaf(0) : measurer.measure(0);
    return wide;
}

int append_wide_tree(Bvh& bvh, const BinaryTree& tree, const CollapsePlan& plan,
                     const WideTree& wide, const IndexedGeometry& geometry) {
    int node = int(bvh.nodes.size()), line = int(bvh.leaves.size());
    bvh.nodes.resize(bvh.nodes.size() + std::size_t(wide.extent.nodes));
    bvh.leaves.resize(bvh.leaves.size() + std::size_t(wide.extent.leaf_lines));
    Collapsed collapsed(tree, plan);
    Writer writer(bvh, collapsed, wide, geometry);
    if (collapsed.is_leaf(0)) return writer.write_leaf_at(0, line);
    writer.write_node(0, node, line);
    return node;
}

int append_empty_node(Bvh& bvh) {
    bvh.nodes.push_back(empty_node());
    return int(bvh.nodes.size()) - 1;
}

} // namespace parhelion
