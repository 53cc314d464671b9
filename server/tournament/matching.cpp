#include "server/tournament/matching.hpp"

#include <algorithm>
#include <deque>
#include <limits>
#include <utility>

namespace poolhall::tournament {
namespace {

using Node = std::size_t;  // a vertex, below the number of vertices, or a blossom
constexpr Node none = std::numeric_limits<Node>::max();

struct Edge {
  Node from = none;  // vertices
  Node to = none;

  [[nodiscard]] bool exists() const { return from != none; }
  [[nodiscard]] Edge turned() const { return {to, from}; }
};

// A node's place in the forest of alternating trees.
enum class Label : std::uint8_t {
  free,   // in no tree
  outer,  // at an even distance from the root
  inner,  // at an odd one
};

// One search grows alternating trees from all unmatched nodes at once until an augmenting path is
// found or the dual variables show that there is none.
class Matcher {
 public:
  explicit Matcher(const WeightedGraph& graph);
  [[nodiscard]] std::vector<std::optional<std::size_t>> solve();

 private:
  [[nodiscard]] bool is_blossom(Node x) const { return x >= n_; }
  [[nodiscard]] Edge& edge(Node x, Node y) { return edges_[x * capacity_ + y]; }
  // Twice the reduced cost: 0 on edges that may be used.
  [[nodiscard]] Weight slack(const Edge& e) const {
    return dual_[e.from] + dual_[e.to] - doubled_[e.from * n_ + e.to];
  }
  [[nodiscard]] bool is_tight(const Edge& e) const {
    return dual_[e.from] + dual_[e.to] == doubled_[e.from * n_ + e.to];
  }

  void offer(Node vertex, Node x);
  void find_offer(Node x);
  void enqueue(Node x);
  void set_root(Node x, Node root);
  [[nodiscard]] std::size_t even_position(Node blossom, Node member);
  void match_along(Node x, Node y);
  void augment(Node x, Node y);
  [[nodiscard]] Node meeting_point(Node x, Node y);
  [[nodiscard]] Node new_blossom_node();
  void append_path(Node blossom, Node from, Node to);
  void add_blossom(Node x, Node base, Node y);
  void adopt_edges(Node blossom);
  void expand(Node blossom);
  [[nodiscard]] bool use(const Edge& e);
  [[nodiscard]] bool grow();
  [[nodiscard]] std::optional<Weight> dual_step() const;
  void move_duals(const Weight& step);
  [[nodiscard]] bool use_tight_offers();
  void expand_spent();
  [[nodiscard]] bool start_search();
  [[nodiscard]] bool find_augmentation();

  std::size_t n_;
  std::size_t capacity_;
  std::size_t nodes_;            // vertices and blossom places in use
  std::vector<Weight> doubled_;  // weights, twice
  std::vector<Edge> edges_;      // between nodes: the best edge of the graph that joins them
  std::vector<Weight> dual_;     // by node
  std::vector<Node> match_;      // by node: the vertex it is matched to
  std::vector<Edge> offer_;      // by node: the least slack edge from an outer vertex
  std::vector<Node> root_;       // by node: the outermost blossom it is in; none: unused place
  std::vector<Node> parent_;     // by node: the vertex above it in its tree
  std::vector<Label> label_;
  std::vector<std::size_t> seen_;
  std::size_t visit_ = 0;
  std::vector<std::vector<Node>> members_;      // of a blossom, in the order of its cycle
  std::vector<std::vector<Node>> member_with_;  // blossom, vertex: the member with the vertex
  std::deque<Node> queue_;                      // outer vertices to look at
};

Matcher::Matcher(const WeightedGraph& graph)
    : n_(graph.vertices()),
      capacity_(n_ + n_ / 2 + 1),
      nodes_(n_),
      doubled_(n_ * n_),
      edges_(capacity_ * capacity_),
      dual_(capacity_),
      match_(capacity_, none),
      offer_(capacity_),
      root_(capacity_, none),
      parent_(capacity_, none),
      label_(capacity_, Label::free),
      seen_(capacity_, 0),
      members_(capacity_),
      member_with_(capacity_) {
  Weight heaviest = 0;
  for (Node a = 0; a < n_; ++a) {
    root_[a] = a;
    for (Node b = 0; b < n_; ++b) {
      const Weight& weight = graph.weight(a, b);
      if (a != b && weight > 0) {
        edge(a, b) = {a, b};
        doubled_[a * n_ + b] = weight << 1U;
        heaviest = std::max(heaviest, weight);
      }
    }
  }
  std::fill(dual_.begin(), dual_.begin() + static_cast<std::ptrdiff_t>(n_), heaviest);
}

std::vector<std::optional<std::size_t>> Matcher::solve() {
  while (find_augmentation()) {
  }
  std::vector<std::optional<std::size_t>> partner(n_);
  for (Node vertex = 0; vertex < n_; ++vertex) {
    if (match_[vertex] != none) {
      partner[vertex] = match_[vertex];
    }
  }
  return partner;
}

// The edge from an outer vertex to `x`, if it is the best so far.
void Matcher::offer(Node vertex, Node x) {
  const Edge& e = edge(vertex, x);
  if (!offer_[x].exists() || slack(e) < slack(offer_[x])) {
    offer_[x] = e;
  }
}

void Matcher::find_offer(Node x) {
  offer_[x] = {};
  for (Node vertex = 0; vertex < n_; ++vertex) {
    if (edge(vertex, x).exists() && root_[vertex] != x && label_[root_[vertex]] == Label::outer) {
      offer(vertex, x);
    }
  }
}

void Matcher::enqueue(Node x) {
  if (!is_blossom(x)) {
    queue_.push_back(x);
    return;
  }
  for (const Node member : members_[x]) {
    enqueue(member);
  }
}

void Matcher::set_root(Node x, Node root) {
  root_[x] = root;
  if (is_blossom(x)) {
    for (const Node member : members_[x]) {
      set_root(member, root);
    }
  }
}

// Where `member` stands in the cycle, which is turned so that the way there from the base has an
// even length.
std::size_t Matcher::even_position(Node blossom, Node member) {
  std::vector<Node>& cycle = members_[blossom];
  const auto at = std::find(cycle.begin(), cycle.end(), member);
  const auto position = static_cast<std::size_t>(at - cycle.begin());
  if (position % 2 == 0) {
    return position;
  }
  std::reverse(cycle.begin() + 1, cycle.end());
  return cycle.size() - position;
}

// Matches node `x` by its edge to node `y`, and inside of `x` what that leaves.
void Matcher::match_along(Node x, Node y) {
  const Edge e = edge(x, y);
  match_[x] = e.to;
  if (!is_blossom(x)) {
    return;
  }
  const Node new_base = member_with_[x][e.from];
  const std::size_t position = even_position(x, new_base);
  std::vector<Node>& cycle = members_[x];
  for (std::size_t i = 0; i < position; ++i) {
    match_along(cycle[i], cycle[i ^ 1U]);
  }
  match_along(new_base, y);
  std::rotate(cycle.begin(), cycle.begin() + static_cast<std::ptrdiff_t>(position), cycle.end());
}

// Turns the matching round on the way from `x`, which is now matched to `y`, up to its root.
void Matcher::augment(Node x, Node y) {
  while (true) {
    const Node before = match_[x];
    match_along(x, y);
    if (before == none) {
      return;
    }
    const Node above = root_[before];
    match_along(above, root_[parent_[above]]);
    x = root_[parent_[above]];
    y = above;
  }
}

// The lowest node that is above both in one tree; none when they are in two.
Node Matcher::meeting_point(Node x, Node y) {
  ++visit_;
  while (x != none || y != none) {
    if (x != none) {
      if (seen_[x] == visit_) {
        return x;
      }
      seen_[x] = visit_;
      x = match_[x] == none ? none : root_[match_[x]];
      if (x != none) {
        x = root_[parent_[x]];
      }
    }
    std::swap(x, y);
  }
  return none;
}

Node Matcher::new_blossom_node() {
  Node blossom = n_;
  while (blossom < nodes_ && root_[blossom] != none) {
    ++blossom;
  }
  nodes_ = std::max(nodes_, blossom + 1);
  return blossom;
}

// The nodes from `from` up to below `to`; the inner ones among them become outer.
void Matcher::append_path(Node blossom, Node from, Node to) {
  for (Node x = from; x != to; x = root_[parent_[members_[blossom].back()]]) {
    members_[blossom].push_back(x);
    const Node above = root_[match_[x]];
    members_[blossom].push_back(above);
    enqueue(above);
  }
}

void Matcher::add_blossom(Node x, Node base, Node y) {
  const Node blossom = new_blossom_node();
  dual_[blossom] = 0;
  label_[blossom] = Label::outer;
  match_[blossom] = match_[base];
  parent_[blossom] = parent_[base];
  members_[blossom].assign(1, base);
  append_path(blossom, x, base);
  std::reverse(members_[blossom].begin() + 1, members_[blossom].end());
  append_path(blossom, y, base);
  set_root(blossom, blossom);
  adopt_edges(blossom);
  find_offer(blossom);
}

// To each other node the blossom has the edge of least slack that one of its members has.
void Matcher::adopt_edges(Node blossom) {
  for (Node x = 0; x < nodes_; ++x) {
    edge(blossom, x) = {};
    edge(x, blossom) = {};
  }
  member_with_[blossom].assign(n_, none);
  for (const Node member : members_[blossom]) {
    for (Node x = 0; x < nodes_; ++x) {
      const Edge& e = edge(member, x);
      if (e.exists() && (!edge(blossom, x).exists() || slack(e) < slack(edge(blossom, x)))) {
        edge(blossom, x) = e;
        edge(x, blossom) = e.turned();
      }
    }
    for (Node vertex = 0; vertex < n_; ++vertex) {
      const bool inside =
          is_blossom(member) ? member_with_[member][vertex] != none : member == vertex;
      if (inside) {
        member_with_[blossom][vertex] = member;
      }
    }
  }
}

// Takes an inner blossom apart: the even way from its base to where the tree enters stays.
void Matcher::expand(Node blossom) {
  for (const Node member : members_[blossom]) {
    set_root(member, member);
  }
  const Node entered = member_with_[blossom][edge(blossom, parent_[blossom]).from];
  const std::size_t position = even_position(blossom, entered);
  const std::vector<Node>& cycle = members_[blossom];
  for (std::size_t i = 0; i < position; i += 2) {
    const Node inner = cycle[i];
    const Node outer = cycle[i + 1];
    parent_[inner] = edge(outer, inner).from;
    label_[inner] = Label::inner;
    label_[outer] = Label::outer;
    offer_[inner] = {};
    find_offer(outer);
    enqueue(outer);
  }
  label_[entered] = Label::inner;
  parent_[entered] = parent_[blossom];
  for (std::size_t i = position + 1; i < cycle.size(); ++i) {
    label_[cycle[i]] = Label::free;
    find_offer(cycle[i]);
  }
  root_[blossom] = none;
}

// Takes a tight edge from an outer vertex into the forest; true when the matching has grown.
bool Matcher::use(const Edge& e) {
  const Node x = root_[e.from];
  const Node y = root_[e.to];
  if (label_[y] == Label::free) {
    parent_[y] = e.from;
    label_[y] = Label::inner;
    const Node below = root_[match_[y]];
    offer_[y] = {};
    offer_[below] = {};
    label_[below] = Label::outer;
    enqueue(below);
  } else if (label_[y] == Label::outer) {
    const Node base = meeting_point(x, y);
    if (base == none) {
      augment(x, y);
      augment(y, x);
      return true;
    }
    add_blossom(x, base, y);
  }
  return false;
}

// Looks at the edges of outer vertices; true when the matching has grown.
bool Matcher::grow() {
  while (!queue_.empty()) {
    const Node vertex = queue_.front();
    queue_.pop_front();
    if (label_[root_[vertex]] == Label::inner) {
      continue;
    }
    for (Node to = 0; to < n_; ++to) {
      if (!edge(vertex, to).exists() || root_[vertex] == root_[to]) {
        continue;
      }
      if (!is_tight(edge(vertex, to))) {
        offer(vertex, root_[to]);
      } else if (use(edge(vertex, to))) {
        return true;
      }
    }
  }
  return false;
}

// How far the duals can move; nothing when the duals of unmatched vertices reach 0 first, and
// then the matching is of greatest weight.
std::optional<Weight> Matcher::dual_step() const {
  std::optional<Weight> step;
  const auto bound = [&step](const Weight& value) {
    if (!step || value < *step) {
      step = value;
    }
  };
  for (Node x = 0; x < nodes_; ++x) {
    if (root_[x] != x) {
      continue;
    }
    if (is_blossom(x) && label_[x] == Label::inner) {
      bound(dual_[x] >> 1U);
    }
    if (offer_[x].exists() && label_[x] == Label::free) {
      bound(slack(offer_[x]));
    } else if (offer_[x].exists() && label_[x] == Label::outer) {
      bound(slack(offer_[x]) >> 1U);
    }
  }
  for (Node vertex = 0; vertex < n_; ++vertex) {
    if (label_[root_[vertex]] == Label::outer && (!step || dual_[vertex] <= *step)) {
      return std::nullopt;
    }
  }
  return step;
}

void Matcher::move_duals(const Weight& step) {
  for (Node vertex = 0; vertex < n_; ++vertex) {
    const Label label = label_[root_[vertex]];
    if (label == Label::outer) {
      dual_[vertex] -= step;
    } else if (label == Label::inner) {
      dual_[vertex] += step;
    }
  }
  for (Node blossom = n_; blossom < nodes_; ++blossom) {
    if (root_[blossom] != blossom) {
      continue;
    }
    if (label_[blossom] == Label::outer) {
      dual_[blossom] += step << 1U;
    } else if (label_[blossom] == Label::inner) {
      dual_[blossom] -= step << 1U;
    }
  }
}

bool Matcher::use_tight_offers() {
  for (Node x = 0; x < nodes_; ++x) {
    if (root_[x] == x && offer_[x].exists() && root_[offer_[x].from] != x && is_tight(offer_[x]) &&
        use(Edge(offer_[x]))) {
      return true;
    }
  }
  return false;
}

void Matcher::expand_spent() {
  for (Node blossom = n_; blossom < nodes_; ++blossom) {
    if (root_[blossom] == blossom && label_[blossom] == Label::inner && dual_[blossom] == 0) {
      expand(blossom);
    }
  }
}

// Makes every unmatched node the root of a tree; false when there is none.
bool Matcher::start_search() {
  queue_.clear();
  for (Node x = 0; x < nodes_; ++x) {
    label_[x] = Label::free;
    offer_[x] = {};
  }
  for (Node x = 0; x < nodes_; ++x) {
    if (root_[x] == x && match_[x] == none) {
      parent_[x] = none;
      label_[x] = Label::outer;
      enqueue(x);
    }
  }
  return !queue_.empty();
}

bool Matcher::find_augmentation() {
  if (!start_search()) {
    return false;
  }
  while (true) {
    if (grow()) {
      return true;
    }
    const auto step = dual_step();
    if (!step) {
      return false;
    }
    move_duals(*step);
    queue_.clear();
    if (use_tight_offers()) {
      return true;
    }
    expand_spent();
  }
}

}  // namespace

std::vector<std::optional<std::size_t>> maximum_weight_matching(const WeightedGraph& graph) {
  return Matcher(graph).solve();
}

}  // namespace poolhall::tournament
