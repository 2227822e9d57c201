// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tripoint {

struct State;

/// Who keeps which body of a scene that processes share (decision 044). Few bodies are kept, that is moved,
/// by every process. Of many each has an owner, found by a hash of its row: it is kept by its owner and by
/// those that have members of it, ghosts too. Others have it as it was when the scene was shared out. All
/// processes make every call that takes a State.
class BodyOwners {
 public:
  /// Finds who keeps what, and brings what is kept here up to date. To be called whenever particles have
  /// changed hands.
  void share(State&);
  /// Every process has all bodies as their owners have them.
  void complete(State&) const;

  /// Whether bodies have owners; else every process keeps all.
  [[nodiscard]] bool any() const noexcept { return !subscribers_.empty(); }
  [[nodiscard]] bool is_here(std::size_t body) const { return owner(body) == here_; }
  /// ascending; none where !any()
  [[nodiscard]] std::span<const std::size_t> kept() const noexcept { return kept_; }
  /// Ids of this process's own members of bodies that move, of each body in the order of their numbers; none
  /// where no body has an owner.
  [[nodiscard]] std::span<const std::uint32_t> members() const noexcept { return members_; }
  /// Whether one process alone has members of its own of a body that is kept here. @pre any()
  [[nodiscard]] bool is_alone(std::size_t body) const { return is_alone_[body] != 0; }
  /// Brings records to the owners of bodies. @param records `width` numbers each, the second of which is the
  /// row of a body
  /// @return those about bodies that this process owns, one process after the other. @pre any()
  [[nodiscard]] std::vector<double> to_owners(const State&, const std::vector<double>& records,
                                              std::size_t width) const;

  using Put = std::function<void(std::size_t body, std::vector<double>& to)>;
  using Take = std::function<void(std::size_t body, const double* from)>;
  /// The owner puts numbers of each of its bodies, which those that keep it too take. @param width of them
  /// @pre any()
  void to_subscribers(const State&, std::size_t width, const Put&, const Take&) const;

 private:
  using Bodies = std::vector<std::size_t>;
  [[nodiscard]] std::size_t owner(std::size_t body) const;
  void find_members(const State&);
  void find_kept(const State&);
  [[nodiscard]] std::vector<Bodies> ask(const State&, const std::vector<Bodies>& begun);
  static void exchange(const State&, const std::vector<Bodies>& there, const std::vector<Bodies>& here,
                       std::size_t width, const Put&, const Take&);

  std::size_t here_ = 0;  ///< this process
  Bodies kept_;
  std::vector<std::uint32_t> members_;
  std::vector<char> has_own_, is_alone_;  ///< of each body: has members of this process's own; of one process
  /// Of each body that this process owns: how many have members of their own
  std::vector<int> holders_;
  std::vector<Bodies> asked_;        ///< of each process: bodies that it owns and this one keeps
  std::vector<Bodies> subscribers_;  ///< of each process: bodies that it keeps and this one owns
};

}  // namespace tripoint
