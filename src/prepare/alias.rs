//! The alias method: choosing among n things in proportion to weights with one look (Vose 1991).

/// A slot of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slot {
    /// Share of the slot that is its own, in [0, 1].
    pub accept: f32,
    /// Who has the rest.
    pub alias: u32,
    /// Chance of being chosen.
    pub chance: f32,
}

/// Builds the table. Weights are finite and not negative; all equal when their sum is 0.
pub fn table(weights: &[f64]) -> Vec<Slot> {
    let n = weights.len();
    let sum: f64 = weights.iter().sum();
    let share = |i: usize| if sum > 0.0 { weights[i] / sum } else { 1.0 / n as f64 };
    let mut slots: Vec<Slot> =
        (0..n).map(|i| Slot { accept: 1.0, alias: i as u32, chance: share(i) as f32 }).collect();
    let mut rest: Vec<f64> = (0..n).map(|i| share(i) * n as f64).collect();
    let (mut small, mut large): (Vec<usize>, Vec<usize>) = (0..n).partition(|&i| rest[i] < 1.0);
    while let (Some(&s), Some(&l)) = (small.last(), large.last()) {
        small.pop();
        slots[s].accept = rest[s] as f32;
        slots[s].alias = l as u32;
        rest[l] -= 1.0 - rest[s];
        if rest[l] < 1.0 {
            large.pop();
            small.push(l);
        }
    }
    slots
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn each_is_chosen_in_proportion_to_its_weight(weights in prop::collection::vec(0.0..10.0_f64, 1..200)) {
            let slots = table(&weights);
            let mut chosen = vec![0.0_f64; weights.len()];
            for (i, slot) in slots.iter().enumerate() {
                chosen[i] += f64::from(slot.accept);
                chosen[slot.alias as usize] += 1.0 - f64::from(slot.accept);
            }
            let sum: f64 = weights.iter().sum();
            for (i, weight) in weights.iter().enumerate() {
                let expected = if sum > 0.0 { weight / sum } else { 1.0 / weights.len() as f64 };
                prop_assert!((chosen[i] / weights.len() as f64 - expected).abs() < 1e-5);
                prop_assert!((f64::from(slots[i].chance) - expected).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn what_has_no_weight_is_never_chosen() {
        let slots = table(&[0.0, 1.0, 0.0, 3.0]);
        assert_eq!((slots[0].accept, slots[2].accept), (0.0, 0.0));
        assert!(slots.iter().all(|slot| slot.accept == 1.0 || slot.alias % 2 == 1));
        assert!(table(&[]).is_empty());
    }
}
