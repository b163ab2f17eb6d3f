// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Serializable adds no data (24 bytes); slots after Factorable's: pySetAttr, pyDict, pyDictCustom,
// callPostLoad, checkPyClassRegistersItself, pyRegisterClass, pyHandleCustomCtorArgs. The keyword constructor
// calls pyHandleCustomCtorArgs, refuses positional arguments that remain, and with keywords given calls
// pyUpdateAttrs and callPostLoad. Names and arguments of the class macros are YADE's. Verified: vtable
// relocations, tests/abi.
#pragma once

#include <lib/base/Math.hpp>
#include <lib/factory/ClassFactory.hpp>
#include <lib/factory/Factorable.hpp>
#include <lib/serialization/Attributes.hpp>
#include <lib/serialization/StockSerializers.hpp>

#include <boost/python/raw_function.hpp>
#include <boost/serialization/base_object.hpp>

namespace yade {

class Serializable : public Factorable {
public:
    Serializable() {}
    virtual ~Serializable();
    string getBaseClassName(unsigned int = 0) const override;
    int getBaseClassNumber() const override;
    string getClassName() const override;

    virtual void pySetAttr(const string& key, const boost::python::object& value);
    virtual boost::python::dict pyDict() const;
    virtual boost::python::dict pyDictCustom() const { return {}; }
    virtual void callPostLoad();
    virtual void checkPyClassRegistersItself(const string& className) const;
    virtual void pyRegisterClass(boost::python::object scope);
    virtual void pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict&) {}

    void pyUpdateAttrs(const boost::python::dict& attributes);
};

namespace abi {
template <class T>
shared_ptr<T> makeFromKeywords(boost::python::tuple positional, boost::python::dict keywords) {
    shared_ptr<T> instance(new T);
    instance->pyHandleCustomCtorArgs(positional, keywords);
    if (const auto left = boost::python::len(positional); left > 0)
        throw runtime_error(instance->getClassName() + " takes no positional arguments (" +
                            std::to_string(left) + " given beyond those it knows); use keywords");
    if (boost::python::len(keywords) > 0) {
        instance->pyUpdateAttrs(keywords);
        instance->callPostLoad();
    }
    return instance;
}

/// Python's __init__(self, *positional, **keywords).
template <class T>
boost::python::object initFromKeywords(boost::python::tuple arguments, boost::python::dict keywords) {
    const boost::python::tuple positional(arguments.slice(1, boost::python::_));
    boost::python::detail::install_holder<shared_ptr<T>> install(arguments.ptr());
    return boost::python::object(boost::python::handle<>(install(makeFromKeywords<T>(positional, keywords))));
}

/// The Python class of T, made inside `where` with YADE's choice of help texts: no C++ signatures.
template <class T, class Base, class Scope>
struct ClassDefinition {
    using PyClass = boost::python::class_<T, shared_ptr<T>, boost::python::bases<Base>, boost::noncopyable>;

    const boost::python::scope inside;
    const boost::python::docstring_options options{true, true, false};
    PyClass pyClass;

    ClassDefinition(const Scope& where, const char* name, const char* doc)
        : inside(where), pyClass(name, doc) {
        pyClass.def("__init__", boost::python::raw_function(&initFromKeywords<T>, 1));
        defineAttributes<T>(pyClass);
    }
};
} // namespace abi

} // namespace yade

// Parts of an attribute tuple (type, name, default, flags, doc); default and flags may be empty.
#define YADE_ABI_TYPE(a) BOOST_PP_TUPLE_ELEM(5, 0, a)
#define YADE_ABI_NAME(a) BOOST_PP_TUPLE_ELEM(5, 1, a)
#define YADE_ABI_DEFAULT(a) BOOST_PP_TUPLE_ELEM(5, 2, a)
#define YADE_ABI_FLAGS(a) (BOOST_PP_TUPLE_ELEM(5, 3, a) + 0)
#define YADE_ABI_DOC(a)                                                                                      \
    BOOST_PP_TUPLE_ELEM(5, 4, a)                                                                             \
    " :ydefault:`" BOOST_PP_STRINGIZE(YADE_ABI_DEFAULT(a)) "` :yattrtype:`" BOOST_PP_STRINGIZE(YADE_ABI_TYPE(a)) "`"

#define YADE_ABI_DECLARE(r, data, a)                                                                         \
    YADE_ABI_TYPE(a) YADE_ABI_NAME(a){::yade::abi::initial<YADE_ABI_TYPE(a)>(YADE_ABI_DEFAULT(a))};
#define YADE_ABI_INITIALISE(r, data, init) , BOOST_PP_TUPLE_ELEM(2, 0, init)(BOOST_PP_TUPLE_ELEM(2, 1, init))
#define YADE_ABI_VISIT(r, klass, a)                                                                          \
    abiVisitor(::yade::abi::Attribute<&klass::YADE_ABI_NAME(a), YADE_ABI_FLAGS(a)>{                          \
        BOOST_PP_STRINGIZE(YADE_ABI_NAME(a)), YADE_ABI_DOC(a)});

// pySetAttr, pyDict and pyRegisterClass are defined by YADE_PLUGIN, in one source file: there, and only
// there, a compiler makes the class's tables and its Python and archive code. (What an inline function calls
// it would make wherever it reads the class: half of the time of a source file with a large class.)
//
// postLoad & co. are called unqualified from inside the class: a member of that name wins over
// yade::postLoad. Parameters are called abi... so that no attribute of any class is shadowed.
#define YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(klass, base, docText, attrs, inits, ctor, extras)             \
public:                                                                                                      \
    BOOST_PP_SEQ_FOR_EACH(YADE_ABI_DECLARE, ~, attrs)                                                        \
    klass() : base() BOOST_PP_SEQ_FOR_EACH(YADE_ABI_INITIALISE, ~, inits) {                                  \
        ctor;                                                                                                \
    }                                                                                                        \
    REGISTER_CLASS_AND_BASE(klass, base)                                                                     \
    template <class AbiVisitor>                                                                              \
    static void visitAttributes(AbiVisitor&& abiVisitor) {                                                   \
        (void)abiVisitor;                                                                                    \
        BOOST_PP_SEQ_FOR_EACH(YADE_ABI_VISIT, klass, attrs)                                                  \
    }                                                                                                        \
    using AbiBase = base;                                                                                    \
    void pySetAttr(const std::string& abiKey, const boost::python::object& abiValue) override;               \
    boost::python::dict pyDict() const override;                                                             \
    void callPostLoad() override {                                                                           \
        base::callPostLoad();                                                                                \
        postLoad(*this);                                                                                     \
    }                                                                                                        \
    void pyRegisterClass(boost::python::object abiScope) override;                                           \
    template <class AbiScope>                                                                                \
    void registerInPython(const AbiScope& abiScope) {                                                        \
        checkPyClassRegistersItself(#klass);                                                                 \
        ::yade::abi::ClassDefinition<klass, base, AbiScope> abiDefinition(abiScope, #klass, docText);        \
        (void)abiDefinition.pyClass extras;                                                                  \
    }                                                                                                        \
                                                                                                             \
private:                                                                                                     \
    friend class boost::serialization::access;                                                               \
    template <class AbiArchive>                                                                              \
    void serialize(AbiArchive& abiArchive, unsigned int) {                                                   \
        abiArchive& boost::serialization::make_nvp(#base, boost::serialization::base_object<base>(*this));   \
        if constexpr (AbiArchive::is_loading::value)                                                         \
            preLoad(*this);                                                                                  \
        else                                                                                                 \
            preSave(*this);                                                                                  \
        ::yade::abi::archiveAttributes(abiArchive, *this);                                                   \
        if constexpr (AbiArchive::is_loading::value)                                                         \
            postLoad(*this);                                                                                 \
        else                                                                                                 \
            postSave(*this);                                                                                 \
    }                                                                                                        \
                                                                                                             \
public:

#define YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(klass, base, doc, attrs, ctor, extras)                             \
    YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(klass, base, doc, attrs, , ctor, extras)
#define YADE_CLASS_BASE_DOC_ATTRS_CTOR(klass, base, doc, attrs, ctor)                                        \
    YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(klass, base, doc, attrs, , ctor, )
#define YADE_CLASS_BASE_DOC_ATTRS(klass, base, doc, attrs)                                                   \
    YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(klass, base, doc, attrs, , , )
#define YADE_CLASS_BASE_DOC(klass, base, doc) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(klass, base, doc, , , , )

// Stands inside namespace yade, which it closes and opens again because Boost's key macro opens its own.
#define REGISTER_SERIALIZABLE(klass)                                                                         \
    }                                                                                                        \
    BOOST_CLASS_EXPORT_KEY(yade::klass)                                                                      \
    namespace yade {

// What every class of the library overrides; with the undefined destructor its vtable and type information
// are the library's own.
#define YADE_ABI_STOCK_CLASS_WITHOUT_PYTHON(klass)                                                           \
public:                                                                                                      \
    virtual ~klass();                                                                                        \
    std::string getBaseClassName(unsigned int = 0) const override;                                           \
    int getBaseClassNumber() const override;                                                                 \
    std::string getClassName() const override;                                                               \
    void pySetAttr(const std::string& key, const boost::python::object& value) override;                     \
    boost::python::dict pyDict() const override;                                                             \
    void callPostLoad() override;

#define YADE_ABI_STOCK_CLASS(klass)                                                                          \
    YADE_ABI_STOCK_CLASS_WITHOUT_PYTHON(klass)                                                               \
    void pyRegisterClass(boost::python::object scope) override;

YADE_ABI_STOCK_SERIALIZERS(Serializable)
