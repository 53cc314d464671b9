#include "server/storage/writer.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "server/meter/work_meter.hpp"
#include "server/storage/failpoint.hpp"

namespace poolhall::storage {

class Writer::Impl {
 public:
  Impl(std::unique_ptr<Database> database, WriterOptions options)
      : database_(std::move(database)), options_(std::move(options)) {
    if (!options_.deliver)
      options_.deliver = [](const std::function<void()>& work) { work(); };
    thread_ = std::thread([this] { run(); });
  }

  Posted post(Work work, Done done);
  void flush();
  void stop();
  WriterStatistics statistics();

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;
  struct Piece {
    Work work;
    Done done;
  };
  struct Told {
    Done done;
    Expected<void> outcome;
  };

  void run();
  std::vector<Piece> next_group();
  void write(std::vector<Piece> group);
  std::optional<StorageError> write_together(const std::vector<Piece>& group);
  std::optional<StorageError> write_apart(std::vector<Piece>& group, std::vector<Told>& told);
  std::optional<StorageError> write_alone(const Piece& piece, std::vector<Told>& told);
  std::optional<StorageError> commit();
  void say(std::optional<StorageError> trouble);
  [[nodiscard]] bool wait_to_retry(std::chrono::milliseconds& pause);
  void tell(std::vector<Told> told, std::size_t pieces);

  std::unique_ptr<Database> database_;
  WriterOptions options_;
  std::optional<StorageFault> trouble_{};  // the writer's thread alone, as are the next two
  SteadyTime began_{};                     // with the last group
  std::size_t last_group_ = 0;             // its pieces

  std::mutex mutex_;
  std::condition_variable posted_;
  std::condition_variable finished_;
  std::deque<Piece> queue_;
  std::uint64_t accepted_ = 0;
  std::uint64_t told_ = 0;
  bool stopping_ = false;
  SteadyTime give_up_{};
  WriterStatistics statistics_{};
  std::thread thread_;
};

Posted Writer::Impl::post(Work work, Done done) {
  const std::lock_guard lock(mutex_);
  if (stopping_)
    return Posted::stopping;
  if (accepted_ - told_ >= options_.queue_bound)
    return Posted::full;
  queue_.push_back({std::move(work), std::move(done)});
  ++accepted_;
  if (queue_.size() == 1)
    posted_.notify_one();
  return Posted::accepted;
}

void Writer::Impl::flush() {
  std::unique_lock lock(mutex_);
  const std::uint64_t until = accepted_;
  finished_.wait(lock, [&] { return told_ >= until; });
}

void Writer::Impl::stop() {
  {
    const std::lock_guard lock(mutex_);
    if (!stopping_)
      give_up_ = std::chrono::steady_clock::now() + options_.patience;
    stopping_ = true;
    posted_.notify_all();
  }
  if (thread_.joinable())
    thread_.join();
}

WriterStatistics Writer::Impl::statistics() {
  const std::lock_guard lock(mutex_);
  WriterStatistics now = statistics_;
  now.waiting = accepted_ - told_;
  return now;
}

std::vector<Writer::Impl::Piece> Writer::Impl::next_group() {
  std::unique_lock lock(mutex_);
  posted_.wait(lock, [&] { return stopping_ || !queue_.empty(); });
  if (last_group_ > 1)
    posted_.wait_until(lock, began_ + options_.between_commits, [&] { return stopping_; });
  began_ = std::chrono::steady_clock::now();
  const std::size_t size = std::min(queue_.size(), options_.group_bound);
  const auto end = queue_.begin() + static_cast<std::ptrdiff_t>(size);
  std::vector<Piece> group(std::make_move_iterator(queue_.begin()), std::make_move_iterator(end));
  queue_.erase(queue_.begin(), end);
  last_group_ = size;
  return group;
}

void Writer::Impl::run() {
  for (std::vector<Piece> group = next_group(); !group.empty(); group = next_group())
    write(std::move(group));
}

// Nothing of the group is lost: it is tried until it is stored, refused for what it is, or the
// writer is stopped and out of patience.
void Writer::Impl::write(std::vector<Piece> group) {
  const std::size_t pieces = group.size();
  std::vector<Told> told;
  std::chrono::milliseconds pause = options_.retry_first;
  for (;;) {
    std::optional<StorageError> error = write_together(group);
    if (error && !may_pass(error->fault))
      error = write_apart(group, told);
    if (!error)
      break;
    say(error);
    if (wait_to_retry(pause))
      continue;
    for (Piece& piece : group)
      told.push_back({std::move(piece.done), tl::unexpected(*error)});
    tell(std::move(told), pieces);
    return;
  }
  say(std::nullopt);
  for (Piece& piece : group)
    told.push_back({std::move(piece.done), {}});
  {
    const std::lock_guard lock(mutex_);
    ++statistics_.commits;
    statistics_.written += group.size();
    statistics_.largest_group = std::max(statistics_.largest_group, std::uint64_t{pieces});
    statistics_.busy += std::chrono::steady_clock::now() - began_;
  }
  tell(std::move(told), pieces);
}

std::optional<StorageError> Writer::Impl::commit() {
  failpoint(Failpoint::before_commit);
  const Expected<void> committed =
      meter::metered(meter::Area::commits, [this] { return database_->commit(); });
  if (!committed) {
    database_->rollback();
    return committed.error();
  }
  failpoint(Failpoint::after_commit);
  return std::nullopt;
}

std::optional<StorageError> Writer::Impl::write_together(const std::vector<Piece>& group) {
  if (group.empty())
    return std::nullopt;
  if (const Expected<void> begun = database_->begin(); !begun)
    return begun.error();
  for (const Piece& piece : group) {
    const Expected<void> written =
        meter::metered(meter::Area::database, [&] { return piece.work(*database_); });
    if (!written) {
      database_->rollback();
      return written.error();
    }
  }
  return commit();
}

// Some piece cannot succeed: each gets a transaction of its own. What was told is taken out of the
// group; the first trouble ends it, and what remains is tried again.
std::optional<StorageError> Writer::Impl::write_apart(std::vector<Piece>& group,
                                                      std::vector<Told>& told) {
  std::size_t done = 0;
  std::optional<StorageError> error;
  while (done < group.size() && !error) {
    error = write_alone(group[done], told);
    if (!error)
      ++done;
  }
  group.erase(group.begin(), group.begin() + static_cast<std::ptrdiff_t>(done));
  return error;
}

std::optional<StorageError> Writer::Impl::write_alone(const Piece& piece, std::vector<Told>& told) {
  if (const Expected<void> begun = database_->begin(); !begun)
    return begun.error();
  const Expected<void> written = piece.work(*database_);
  std::optional<StorageError> error;
  if (written)
    error = commit();
  else
    database_->rollback();
  if (error && may_pass(error->fault))
    return error;
  if (!written && may_pass(written.error().fault))
    return written.error();
  if (error)
    told.push_back({piece.done, tl::unexpected(*error)});
  else
    told.push_back({piece.done, written});
  return std::nullopt;
}

void Writer::Impl::say(std::optional<StorageError> trouble) {
  const std::optional<StorageFault> fault = trouble ? std::optional(trouble->fault) : std::nullopt;
  if (fault == trouble_)
    return;
  trouble_ = fault;
  if (!options_.on_health)
    return;
  std::uint64_t waiting = 0;
  {
    const std::lock_guard lock(mutex_);
    waiting = accepted_ - told_;
  }
  options_.deliver([on_health = options_.on_health,
                    health = WriterHealth{std::move(trouble), waiting}] { on_health(health); });
}

bool Writer::Impl::wait_to_retry(std::chrono::milliseconds& pause) {
  std::unique_lock lock(mutex_);
  // A stop ends the pause, then the retries come quickly until the patience is over.
  if (stopping_) {
    const SteadyTime now = std::chrono::steady_clock::now();
    if (now >= give_up_)
      return false;
    finished_.wait_for(lock, options_.retry_first, [] { return false; });
    return true;
  }
  posted_.wait_for(lock, pause, [&] { return stopping_; });
  pause = std::min(2 * pause, options_.retry_longest);
  return true;
}

void Writer::Impl::tell(std::vector<Told> told, std::size_t pieces) {
  options_.deliver([told = std::make_shared<std::vector<Told>>(std::move(told))] {
    for (const Told& one : *told) {
      if (one.done)
        one.done(one.outcome);
    }
  });
  const std::lock_guard lock(mutex_);
  told_ += pieces;
  finished_.notify_all();
}

Writer::Writer(std::unique_ptr<Database> database, WriterOptions options)
    : impl_(std::make_unique<Impl>(std::move(database), std::move(options))) {}

Writer::~Writer() {
  stop();
}

Posted Writer::post(Work work, Done done) {
  return impl_->post(std::move(work), std::move(done));
}

void Writer::flush() {
  impl_->flush();
}

void Writer::stop() {
  impl_->stop();
}

WriterStatistics Writer::statistics() const {
  return impl_->statistics();
}

}  // namespace poolhall::storage
