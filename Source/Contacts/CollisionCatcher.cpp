// SPDX-License-Identifier: MIT
// From an engine's words to records.
#include "Contacts/CollisionCatcher.h"
#include <algorithm>

namespace physvib {

CollisionCatcher::CollisionCatcher(const FixtureTable& table, ContactGraph& graph)
    : table_(table)
    , graph_(graph) {
    records_.reserve(maxDirectRecords + maxDistantRecords);
    ends_.reserve(maxDirectRecords + maxDistantRecords);
}

void CollisionCatcher::beginStep() {
    loads_.resize(table_.size());
    isStepping_ = true;
}

void CollisionCatcher::settle() noexcept {
    isStepping_ = false;
    loads_.settle();
}

void CollisionCatcher::endStep() {
    for (const ContactRecord& record : records_) {
        recordOf_.erase(record.contact);
        if (isFelt(record.a, record.b)) loads_.begin(record.a, record.b);
    }
    loads_.endStep(graph_);
    records_.clear();
    ends_.clear();
    directRecords_ = 0;
    order_ = 0;
}

void CollisionCatcher::forget(std::int32_t slot) noexcept {
    const auto isOf = [slot](const auto& noted) { return noted.a == slot || noted.b == slot; };
    for (const ContactRecord& record : records_)
        if (isOf(record)) recordOf_.erase(record.contact);
    std::erase_if(records_, isOf);
    std::erase_if(ends_, isOf);
    loads_.forget(slot);
}

ContactRecord* CollisionCatcher::begin(std::uint64_t contact, std::int32_t a, std::int32_t b) {
    graph_.insert(a, b);
    if (!isStepping_) return nullptr;
    const bool isDirect = isFelt(a, b);
    const std::size_t count = isDirect ? directRecords_ : records_.size() - directRecords_;
    if (count == (isDirect ? maxDirectRecords : maxDistantRecords)) {
        ++drops_;
        return nullptr;
    }
    directRecords_ += isDirect ? 1 : 0;
    if (begun(contact) == nullptr) recordOf_.set(contact, static_cast<std::int32_t>(records_.size()));
    ContactRecord& record = records_.emplace_back();
    record.contact = contact;
    record.a = a;
    record.b = b;
    record.order = order_++;
    return &record;
}

ContactEnd* CollisionCatcher::end(std::int32_t a, std::int32_t b) {
    graph_.erase(a, b);
    if (ends_.size() == ends_.capacity()) return nullptr;
    ContactEnd& end = ends_.emplace_back();
    end.a = a;
    end.b = b;
    end.order = order_++;
    return &end;
}

ContactRecord* CollisionCatcher::begun(std::uint64_t contact) noexcept {
    const std::int32_t known = recordOf_.find(contact);
    return known == IntegerMap::none ? nullptr : &records_[static_cast<std::size_t>(known)];
}

bool CollisionCatcher::isFelt(std::int32_t a, std::int32_t b) const noexcept {
    return table_[a].values.isCamera || table_[b].values.isCamera;
}

} // namespace physvib
