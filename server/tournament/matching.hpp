// A matching of greatest weight in a general graph, exact for integer weights of any size.
//
//   WeightedGraph graph(4);
//   graph.set(0, 1, 5);
//   std::vector<std::optional<std::size_t>> partner = maximum_weight_matching(graph);
//
// Edmonds' blossom algorithm in the primal-dual form of Galil, "Efficient algorithms for finding
// maximum matching in graphs", ACM Computing Surveys 18 (1986), for dense graphs: O(n^3) steps.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

namespace poolhall::tournament {

// Up to 1024 bits without allocation, more with.
using Weight = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<1024, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked>,
    boost::multiprecision::et_off>;

class WeightedGraph {
 public:
  explicit WeightedGraph(std::size_t vertices)
      : vertices_(vertices), weights_(vertices * vertices) {}

  [[nodiscard]] std::size_t vertices() const { return vertices_; }
  // Only edges of a positive weight exist.
  void set(std::size_t a, std::size_t b, const Weight& weight) {
    weights_[a * vertices_ + b] = weight;
    weights_[b * vertices_ + a] = weight;
  }
  [[nodiscard]] const Weight& weight(std::size_t a, std::size_t b) const {
    return weights_[a * vertices_ + b];
  }

 private:
  std::size_t vertices_;
  std::vector<Weight> weights_;
};

// For each vertex its partner, if it has one.
[[nodiscard]] std::vector<std::optional<std::size_t>> maximum_weight_matching(
    const WeightedGraph& graph);

}  // namespace poolhall::tournament
