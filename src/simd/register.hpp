// What the registers of all instruction sets have in common, in the namespace of the set that is
// open; see begin.hpp.

namespace harmorph::simd::HARMORPH_SET {

// What every register of `n` numbers has. Addresses in memory need no alignment.
template <class Of, Index n>
struct Register {
    static constexpr Index lanes = n;
    typedef Of Vector __attribute__((vector_size(n * sizeof(Of))));
    // Unsigned integers as wide as the numbers, for their bits.
    using Word = typename std::conditional<sizeof(Of) == 8, std::uint64_t, std::uint32_t>::type;
    typedef Word Words __attribute__((vector_size(n * sizeof(Of))));

    static HARMORPH_INLINE Vector load(const Of* from) noexcept {
        return *reinterpret_cast<const Stored*>(from);
    }
    static HARMORPH_INLINE void store(Of* to, Vector v) noexcept {
        *reinterpret_cast<Stored*>(to) = v;
    }
    static HARMORPH_INLINE Words load_words(const Word* from) noexcept {
        return *reinterpret_cast<const StoredWords*>(from);
    }
    static HARMORPH_INLINE void store_words(Word* to, Words v) noexcept {
        *reinterpret_cast<StoredWords*>(to) = v;
    }
    static HARMORPH_INLINE Vector all(Of x) noexcept {
        return x - Vector{};
    }  // the bits of x: -0.0 - 0.0 is -0.0

private:
    typedef Of Stored __attribute__((vector_size(n * sizeof(Of)), aligned(sizeof(Of)), may_alias));
    typedef Word StoredWords
        __attribute__((vector_size(n * sizeof(Of)), aligned(sizeof(Of)), may_alias));
};

}  // namespace harmorph::simd::HARMORPH_SET
