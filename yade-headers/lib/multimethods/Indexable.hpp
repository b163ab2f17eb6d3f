// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Indexable is one vptr; slots increment, modifyClassIndex, D1, D0, getClassIndex, getBaseClassIndex,
// getMax. A class takes its index (one above the family's highest) in its constructor; the counter stays in
// the stock library. Verified: thunks in the secondary vtables of the installed libraries, tests/abi.
#pragma once

#include <memory>
#include <stdexcept>

namespace yade {

class Indexable {
protected:
    void createIndex() {
        int& index = modifyClassIndex();
        if (index != -1)
            return;
        index = getMaxCurrentlyUsedClassIndexOfKin() + 1;
        incrementMaxCurrentlyUsedClassIndexOfKin();
    }
    virtual void incrementMaxCurrentlyUsedClassIndexOfKin() { unregistered(); }
    virtual int& modifyClassIndex() { unregistered(); }

public:
    virtual ~Indexable() = default;
    virtual const int& getClassIndex() const { unregistered(); }
    virtual const int& getBaseClassIndex(int) const { unregistered(); }
    virtual const int& getMaxCurrentlyUsedClassIndexOfKin() const { unregistered(); }

private:
    [[noreturn]] static void unregistered() {
        throw std::logic_error("class without REGISTER_CLASS_INDEX used in multiple dispatch");
    }
};

} // namespace yade

#define REGISTER_CLASS_INDEX(klass, base)                                                                    \
private:                                                                                                     \
    static int& modifyClassIndexStatic() {                                                                   \
        static int index = -1;                                                                               \
        return index;                                                                                        \
    }                                                                                                        \
                                                                                                             \
protected:                                                                                                   \
    int& modifyClassIndex() override {                                                                       \
        return modifyClassIndexStatic();                                                                     \
    }                                                                                                        \
                                                                                                             \
public:                                                                                                      \
    static const int& getClassIndexStatic() {                                                                \
        return modifyClassIndexStatic();                                                                     \
    }                                                                                                        \
    const int& getClassIndex() const override {                                                              \
        return modifyClassIndexStatic();                                                                     \
    }                                                                                                        \
    const int& getBaseClassIndex(int depth) const override {                                                 \
        static const std::unique_ptr<base> above(new base);                                                  \
        return depth == 1 ? above->getClassIndex() : above->getBaseClassIndex(depth - 1);                    \
    }

// For interface classes of the library: the functions exist there, here they are only named. Their order
// among each other and after other new virtual functions is part of the binary interface.
#define YADE_ABI_INDEX                                                                                       \
protected:                                                                                                   \
    int& modifyClassIndex() override;                                                                        \
                                                                                                             \
public:                                                                                                      \
    const int& getClassIndex() const override;                                                               \
    const int& getBaseClassIndex(int) const override;

#define YADE_ABI_INDEX_FAMILY                                                                                \
    YADE_ABI_INDEX                                                                                           \
    const int& getMaxCurrentlyUsedClassIndexOfKin() const override;                                          \
                                                                                                             \
protected:                                                                                                   \
    void incrementMaxCurrentlyUsedClassIndexOfKin() override;                                                \
                                                                                                             \
public:
