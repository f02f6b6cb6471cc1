//! Polynomials with whole coefficients of any size, and their real roots, told apart by Sturm's theorem.

use num_bigint::{BigInt, Sign};

/// Coefficients, the constant first; the last is not zero.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Polynomial(Vec<BigInt>);

/// n/2^k.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Dyadic {
    pub(crate) numerator: BigInt,
    pub(crate) halvings: u32,
}

impl Dyadic {
    pub(crate) fn whole(n: i64) -> Self {
        Self { numerator: n.into(), halvings: 0 }
    }

    /// The value of an f32 from 0 to 1, or as good as that: what is below 2^−149 does not occur.
    pub(crate) fn of(value: f32) -> Self {
        let (mut value, mut halvings) = (f64::from(value), 0);
        while value.fract() != 0.0 {
            value *= 2.0;
            halvings += 1;
        }
        Self { numerator: BigInt::from(value as i128), halvings }
    }

    pub(crate) fn middle(&self, other: &Self) -> Self {
        let halvings = self.halvings.max(other.halvings);
        let scaled = |d: &Self| &d.numerator << (halvings - d.halvings);
        Self { numerator: scaled(self) + scaled(other), halvings: halvings + 1 }
    }

    pub(crate) fn is_below(&self, other: &Self) -> bool {
        let halvings = self.halvings.max(other.halvings);
        &self.numerator << (halvings - self.halvings) < &other.numerator << (halvings - other.halvings)
    }

    pub(crate) fn to_f64(&self) -> f64 {
        let (digits, sign) =
            (self.numerator.magnitude(), if self.numerator.sign() == Sign::Minus { -1.0 } else { 1.0 });
        let shift = digits.bits().saturating_sub(60);
        let head = (digits >> shift).iter_u64_digits().next().unwrap_or(0) as f64;
        sign * head * 2.0_f64.powi(shift as i32 - self.halvings as i32)
    }
}

impl Polynomial {
    pub(crate) fn new(coefficients: impl IntoIterator<Item = BigInt>) -> Self {
        let mut coefficients: Vec<_> = coefficients.into_iter().collect();
        while coefficients.last().is_some_and(|c| c.sign() == Sign::NoSign) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    /// c + m t.
    pub(crate) fn line(c: i64, m: i64) -> Self {
        Self::new([c.into(), m.into()])
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        let at = |p: &Self, i: usize| p.0.get(i).cloned().unwrap_or_default();
        Self::new((0..self.0.len().max(other.0.len())).map(|i| at(self, i) + at(other, i)))
    }

    pub(crate) fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    fn negated(&self) -> Self {
        Self(self.0.iter().map(|c| -c).collect())
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        let mut product = vec![BigInt::default(); self.0.len() + other.0.len()];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        Self::new(product)
    }

    fn derivative(&self) -> Self {
        Self::new(self.0.iter().enumerate().skip(1).map(|(i, c)| c * i))
    }

    /// −1, 0 or 1.
    pub(crate) fn sign_at(&self, t: &Dyadic) -> i32 {
        let mut sum = BigInt::default();
        // Horner, times 2^(halvings · degree).
        for (i, c) in self.0.iter().rev().enumerate() {
            sum = sum * &t.numerator + (c << (t.halvings as usize * i));
        }
        sign(&sum)
    }

    /// A positive multiple of the remainder, and of the quotient.
    fn divided_by(&self, divisor: &Self) -> (Self, Self) {
        let (mut rest, mut quotient) = (self.clone(), Self(Vec::new()));
        let lead = &divisor.0[divisor.0.len() - 1];
        while rest.0.len() >= divisor.0.len() {
            let (places, top) = (rest.0.len() - divisor.0.len(), rest.0[rest.0.len() - 1].clone());
            let factor = if lead.sign() == Sign::Minus { -top } else { top };
            let mut shift = vec![BigInt::default(); places];
            shift.push(factor);
            let shift = Self(shift);
            let grow = Self::new([BigInt::from(lead.magnitude().clone())]);
            quotient = quotient.times(&grow).plus(&shift);
            rest = rest.times(&grow).minus(&shift.times(divisor));
        }
        (quotient, rest.primitive())
    }

    /// Without what all coefficients have in common.
    fn primitive(self) -> Self {
        let common = self.0.iter().fold(BigInt::default(), gcd);
        if common.sign() == Sign::NoSign { self } else { Self(self.0.iter().map(|c| c / &common).collect()) }
    }

    pub(crate) fn common_divisor(&self, other: &Self) -> Self {
        let (mut p, mut q) = (self.clone(), other.clone());
        while !q.is_zero() {
            (p, q) = (q.clone(), p.divided_by(&q).1);
        }
        p.primitive()
    }

    /// With the same roots, each once.
    pub(crate) fn with_simple_roots(&self) -> Self {
        let repeated = self.common_divisor(&self.derivative());
        if repeated.0.len() <= 1 { self.clone() } else { self.divided_by(&repeated).0.primitive() }
    }

    /// How many different roots there are in (low, high]; it must have simple roots only, and not be zero.
    pub(crate) fn roots_in(&self, low: &Dyadic, high: &Dyadic) -> usize {
        let mut chain = vec![self.clone(), self.derivative()];
        while let [.., p, q] = chain.as_slice()
            && !q.is_zero()
        {
            chain.push(p.divided_by(q).1.negated());
        }
        let changes = |t: &Dyadic| {
            let signs: Vec<i32> = chain.iter().map(|p| p.sign_at(t)).filter(|&s| s != 0).collect();
            signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
        };
        changes(low) - changes(high)
    }
}

pub(crate) fn sign(n: &BigInt) -> i32 {
    match n.sign() {
        Sign::Minus => -1,
        Sign::NoSign => 0,
        Sign::Plus => 1,
    }
}

fn gcd(a: BigInt, b: &BigInt) -> BigInt {
    let (mut a, mut b) = (a, b.clone());
    while b.sign() != Sign::NoSign {
        (a, b) = (b.clone(), a % b);
    }
    BigInt::from(a.magnitude().clone())
}

#[test]
fn roots_are_counted_once_and_told_apart() {
    let of = |roots: &[i64]| {
        roots.iter().fold(Polynomial::line(1, 0), |p, &root| p.times(&Polynomial::line(-root, 1)))
    };
    let p = of(&[1, 1, 2, -3]).with_simple_roots();
    let count = |low, high| p.roots_in(&Dyadic::whole(low), &Dyadic::whole(high));
    assert_eq!((count(-10, 10), count(0, 1), count(1, 2), count(2, 9), count(-3, 0)), (3, 1, 1, 0, 0));
    let irrational = Polynomial::new([(-2).into(), 0.into(), 1.into()]);
    assert_eq!(irrational.roots_in(&Dyadic::of(0.5), &Dyadic::whole(2)), 1);
    assert_eq!(of(&[1, 2]).common_divisor(&of(&[2, 3])).sign_at(&Dyadic::whole(2)), 0);
    assert_eq!(Dyadic::of(0.375).middle(&Dyadic::whole(1)).to_f64(), 0.6875);
}
