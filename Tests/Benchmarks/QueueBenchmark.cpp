// SPDX-License-Identifier: GPL-3.0-or-later
// The event queue: through one thread, in batches, and from one thread to another.
#include "Core/CollisionEvent.h"
#include "Core/EventQueue.h"
#include <atomic>
#include <benchmark/benchmark.h>
#include <memory>
#include <thread>

namespace {

using physvib::CollisionEvent;
using Queue = physvib::EventQueue<CollisionEvent, 1024>;

/// Argument: events pushed before they are popped.
void oneThread(benchmark::State& state) {
    const auto queue = std::make_unique<Queue>();
    CollisionEvent event;
    for (auto _ : state) {
        for (std::int64_t i = 0; i < state.range(0); ++i) {
            event.timeNs = i;
            queue->push(event);
        }
        for (std::int64_t i = 0; i < state.range(0); ++i) queue->pop(event);
        benchmark::DoNotOptimize(event);
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(oneThread)->Name("queue/one_thread")->ArgName("batch")->Arg(1)->Arg(64);

void twoThreads(benchmark::State& state) {
    const auto queue = std::make_unique<Queue>();
    std::atomic<bool> isOver{false};
    std::thread producer{[&] {
        CollisionEvent event;
        while (!isOver.load(std::memory_order_relaxed)) {
            ++event.timeNs;
            queue->push(event);
        }
    }};
    CollisionEvent event;
    for (auto _ : state)
        while (!queue->pop(event)) {
        }
    isOver = true;
    producer.join();
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(twoThreads)->Name("queue/two_threads")->UseRealTime();

} // namespace
