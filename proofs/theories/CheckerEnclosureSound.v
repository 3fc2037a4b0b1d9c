(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What the intervals of CheckerEnclosure.v hold: the real numbers that the operations are about. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool AltSeries.
From Dyadel Require Import Leaves Brackets CheckerEnclosure.
Import ListNotations.
Open Scope R_scope.

(* In units of 1 / u. *)
Definition holds (u : Z) (e : interval) (x : R) : Prop :=
  match e with Some (a, b) => IZR a <= x * IZR u <= IZR b | None => True end.

Lemma floor_le a b : (0 < b)%Z -> IZR (a / b) * IZR b <= IZR a.
Proof. intros P. rewrite <- mult_IZR. apply IZR_le. rewrite Z.mul_comm. now apply Z.mul_div_le. Qed.

Lemma ceil_ge a b : (0 < b)%Z -> IZR a <= IZR (ceil a b) * IZR b.
Proof.
  intros P. rewrite <- mult_IZR. apply IZR_le. unfold ceil. pose proof (Z.mul_div_le (- a) b P). lia.
Qed.

Lemma floor_below a b x : (0 < b)%Z -> IZR a <= x * IZR b -> IZR (a / b) <= x.
Proof. intros P H. pose proof (floor_le a b P). apply IZR_lt in P. apply Rmult_le_reg_r with (IZR b); lra. Qed.

Lemma ceil_above a b x : (0 < b)%Z -> x * IZR b <= IZR a -> x <= IZR (ceil a b).
Proof. intros P H. pose proof (ceil_ge a b P). apply IZR_lt in P. apply Rmult_le_reg_r with (IZR b); lra. Qed.

Section Sound.

Variable most : Z.
Variable root_hint : Z -> Z -> Z.
Variable pi_hint : Z -> Z.

Section Unit.

Variable u : Z.
Variable U : (0 < u)%Z.
Let S := IZR u.

Lemma unit_above : 0 < S.
Proof. now apply IZR_lt. Qed.

Lemma whole_holds n : holds u (whole u n) (IZR n).
Proof. unfold holds, whole. rewrite mult_IZR. lra. Qed.

Lemma fraction_holds n d : (0 < d)%Z -> holds u (fraction u n d) (IZR n / IZR d).
Proof.
  intros P. unfold holds, fraction. replace (0 <? d)%Z with true by (symmetry; now apply Z.ltb_lt).
  pose proof (IZR_lt _ _ P) as Q. assert (E : IZR n / IZR d * IZR u * IZR d = IZR (n * u)) by (rewrite mult_IZR;
    field; lra).
  split; [apply floor_below | apply ceil_above]; trivial; lra.
Qed.

Lemma sign_positive e x : holds u e x -> sign_of e = 1%Z -> 0 < x.
Proof.
  unfold holds, sign_of. destruct e as [[a b] |]; [| discriminate]. intros [H _].
    destruct (Z.ltb_spec 0 a) as [A | A].
  - intros _. apply IZR_lt in A. pose proof unit_above. apply Rmult_lt_reg_r with S; unfold S in *; lra.
  - destruct (b <? 0)%Z; discriminate.
Qed.

Lemma sign_negative e x : holds u e x -> sign_of e = (-1)%Z -> x < 0.
Proof.
  unfold holds, sign_of. destruct e as [[a b] |]; [| discriminate]. intros [_ H].
    destruct (0 <? a)%Z; [discriminate |].
  destruct (Z.ltb_spec b 0) as [B | B]; [| discriminate]. intros _. apply IZR_lt in B. pose proof unit_above.
  apply Rmult_lt_reg_r with S; unfold S in *; lra.
Qed.

Lemma sign_cases e : sign_of e = 1%Z \/ sign_of e = (-1)%Z \/ sign_of e = 0%Z.
Proof. destruct e as [[a b] |]; unfold sign_of; [destruct (0 <? a)%Z, (b <? 0)%Z |]; auto. Qed.

Lemma sign_not_zero e x : holds u e x -> sign_of e <> 0%Z -> x <> 0.
Proof.
  intros H N. destruct (sign_cases e) as [E | [E | E]]; [| | contradiction].
  - pose proof (sign_positive e x H E). lra.
  - pose proof (sign_negative e x H E). lra.
Qed.

Lemma add_holds e f x y : holds u e x -> holds u f y -> holds u (add e f) (x + y).
Proof.
  destruct e as [[a b] |], f as [[c d] |]; simpl; trivial. intros [] []. rewrite !plus_IZR, Rmult_plus_distr_r. lra.
Qed.

Lemma neg_holds e x : holds u e x -> holds u (neg e) (- x).
Proof. destruct e as [[a b] |]; simpl; trivial. intros []. rewrite !opp_IZR. lra. Qed.

Lemma sub_holds e f x y : holds u e x -> holds u f y -> holds u (sub e f) (x - y).
Proof. intros. unfold sub, Rminus. now apply add_holds, neg_holds. Qed.

Lemma small_holds e x : holds u e x -> holds u (kept_small most e) x.
Proof. destruct e as [[a b] |]; simpl; trivial. destruct ((Z.abs a <? most) && (Z.abs b <? most))%Z; simpl; trivial.
  Qed.

Lemma between_products a b x y : a <= x <= b -> Rmin (a * y) (b * y) <= x * y <= Rmax (a * y) (b * y).
Proof.
  intros []. destruct (Rle_lt_dec 0 y).
  - split; [apply Rle_trans with (a * y); [apply Rmin_l |] | apply Rle_trans with (b * y); [| apply Rmax_r]]; nra.
  - split; [apply Rle_trans with (b * y); [apply Rmin_r |] | apply Rle_trans with (a * y); [| apply Rmax_l]]; nra.
Qed.

Lemma min_IZR a b : IZR (Z.min a b) = Rmin (IZR a) (IZR b).
Proof.
  destruct (Z.min_spec a b) as [[L ->] | [L ->]]; [rewrite Rmin_left | rewrite Rmin_right]; trivial;
    [apply IZR_lt in L; lra | now apply IZR_le].
Qed.

Lemma max_IZR a b : IZR (Z.max a b) = Rmax (IZR a) (IZR b).
Proof.
  destruct (Z.max_spec a b) as [[L ->] | [L ->]]; [rewrite Rmax_right | rewrite Rmax_left]; trivial;
    [apply IZR_lt in L; lra | now apply IZR_le].
Qed.

Lemma four_products a b c d x y : a <= x <= b -> c <= y <= d ->
  Rmin (Rmin (a * c) (a * d)) (Rmin (b * c) (b * d)) <= x * y <= Rmax (Rmax (a * c) (a * d)) (Rmax (b * c) (b * d)).
Proof.
  intros X Y. destruct (between_products a b x y X) as [L H].
  assert (K : forall z, Rmin (z * c) (z * d) <= z * y <= Rmax (z * c) (z * d)).
  { intros z. rewrite !(Rmult_comm z). now apply between_products. }
  destruct (K a), (K b). unfold Rmin, Rmax in *. repeat destruct (Rle_dec _ _); split; lra.
Qed.

Lemma mul_holds e f x y : holds u e x -> holds u f y -> holds u (mul most u e f) (x * y).
Proof.
  destruct e as [[a b] |], f as [[c d] |]; try (intros; exact I). intros X Y. unfold mul. apply small_holds.
    unfold holds in *.
  destruct (four_products _ _ _ _ _ _ X Y) as [L H]. rewrite <- !mult_IZR, <- !min_IZR in L.
    rewrite <- !mult_IZR, <- !max_IZR in H.
  split; [apply floor_below | apply ceil_above]; trivial; lra.
Qed.

Lemma over_holds d e x : (0 < d)%Z -> holds u e x -> holds u (over d e) (x / IZR d).
Proof.
  intros P. destruct e as [[a b] |]; simpl; trivial. intros []. pose proof (IZR_lt _ _ P).
  assert (E : x / IZR d * IZR u * IZR d = x * IZR u) by (field; lra).
  split; [apply floor_below | apply ceil_above]; trivial; lra.
Qed.

Lemma inverse_positive_holds e x : holds u e x -> holds u (inverse_positive u e) (/ x).
Proof.
  destruct e as [[a b] |]; simpl; trivial. intros [A B]. destruct (Z.ltb_spec 0 a) as [P | P]; simpl; trivial.
  apply IZR_lt in P. pose proof unit_above as Q. unfold S in Q.
    assert (X : 0 < x) by (apply Rmult_lt_reg_r with (IZR u); lra).
  assert (B0 : 0 < IZR b) by lra. split.
  - apply floor_below; [now apply lt_IZR |]. rewrite mult_IZR. apply Rmult_le_reg_l with x; [exact X |].
    replace (x * (/ x * IZR u * IZR b)) with (IZR u * IZR b) by (field; lra).
    replace (x * (IZR u * IZR u)) with (IZR u * (x * IZR u)) by ring. apply Rmult_le_compat_l; lra.
  - apply ceil_above; [now apply lt_IZR |]. rewrite mult_IZR. apply Rmult_le_reg_l with x; [exact X |].
    replace (x * (/ x * IZR u * IZR a)) with (IZR u * IZR a) by (field; lra).
    replace (x * (IZR u * IZR u)) with (IZR u * (x * IZR u)) by ring. apply Rmult_le_compat_l; lra.
Qed.

Lemma inverse_holds e x : holds u e x -> holds u (inverse u e) (/ x).
Proof.
  intros H. unfold inverse. destruct (sign_of e =? 1)%Z; [now apply inverse_positive_holds |].
  destruct (Req_dec x 0) as [-> | N].
  - apply neg_holds in H. destruct e as [[a b] |]; simpl in *; trivial.
    destruct (Z.ltb_spec 0 (- b)) as [P | P]; simpl; trivial.
    apply IZR_lt in P. lra.
  - replace (/ x) with (- / - x) by (field; exact N). apply neg_holds, inverse_positive_holds, neg_holds, H.
Qed.

Lemma quotient_holds e f x y : holds u e x -> holds u f y -> holds u (quotient most u e f) (x / y).
Proof. intros. unfold quotient, Rdiv. now apply mul_holds, inverse_holds. Qed.

Lemma power_holds e x n : holds u e x -> holds u (power most u e n) (x ^ Pos.to_nat n).
Proof.
  intros H. induction n as [n IH | n IH |]; cbn [power].
  - rewrite Pos2Nat.inj_xI. simpl. rewrite Nat.add_0_r, pow_add. now apply mul_holds, mul_holds.
  - rewrite Pos2Nat.inj_xO. simpl. rewrite Nat.add_0_r, pow_add. now apply mul_holds.
  - simpl. rewrite Rmult_1_r. exact H.
Qed.

Lemma power_Z_holds e x n : holds u e x -> holds u (power_Z most u e n) (powerRZ x n).
Proof.
  intros H. destruct n as [| n | n]; simpl powerRZ; cbn [power_Z]; [apply (whole_holds 1) | now apply power_holds |].
  now apply inverse_holds, power_holds.
Qed.

Lemma absolute_holds e x : holds u e x -> holds u (absolute e) (Rabs x).
Proof.
  destruct e as [[a b] |]; simpl; trivial. intros [A B]. pose proof unit_above as Q. unfold S in Q.
  destruct (Z.leb_spec 0 a) as [P | P]; [| destruct (Z.leb_spec b 0) as [N | N]]; simpl.
  - apply IZR_le in P. rewrite Rabs_pos_eq; [lra |]. apply Rmult_le_reg_r with (IZR u); lra.
  - apply IZR_le in N. rewrite Rabs_left1, !opp_IZR; [lra |]. apply Rmult_le_reg_r with (IZR u); lra.
  - rewrite max_IZR, opp_IZR. unfold Rabs, Rmax. destruct (Rcase_abs x), (Rle_dec _ _); split; nra.
Qed.

Lemma least_holds e f x y : holds u e x -> holds u f y -> holds u (least e f) (Rmin x y).
Proof.
  destruct e as [[a b] |], f as [[c d] |]; simpl; trivial. intros [] []. rewrite !min_IZR.
    pose proof unit_above as Q. unfold S in Q.
  unfold Rmin. repeat destruct (Rle_dec _ _); split; nra.
Qed.

Lemma max_of_min x y : Rmax x y = - Rmin (- x) (- y).
Proof. unfold Rmax, Rmin. repeat destruct (Rle_dec _ _); lra. Qed.

Lemma greatest_holds e f x y : holds u e x -> holds u f y -> holds u (greatest e f) (Rmax x y).
Proof. intros. rewrite max_of_min. now apply neg_holds, least_holds; apply neg_holds. Qed.

Lemma join_holds e f x y z : holds u e x -> holds u f y -> x <= z <= y -> holds u (join e f) z.
Proof.
  destruct e as [[a b] |], f as [[c d] |]; simpl; trivial. intros [] [] []. pose proof unit_above as Q.
    unfold S in Q. split; nra.
Qed.

(* ---- roots ---- *)

Lemma square_root_holds e x : holds u e x -> 0 <= x -> holds u (square_root root_hint u e) (sqrt x).
Proof.
  destruct e as [[a b] |]; simpl; trivial. intros [A B] X. pose proof unit_above as Q. unfold S in Q.
  set (a' := Z.max 0 a). set (r := root_hint 2 (a' * u)). set (s0 := root_hint 2 (b * u)).
  set (s := if (b * u <=? s0 * s0)%Z then s0 else (s0 + 1)%Z).
  destruct ((0 <=? r) && (r * r <=? a' * u) && (0 <=? s) && (b * u <=? s * s))%Z eqn:E; simpl; trivial.
  repeat (apply andb_prop in E as [E ?]). rewrite Z.leb_le in *.
  assert (A' : IZR a' <= x * IZR u) by (unfold a'; rewrite max_IZR; unfold Rmax; destruct (Rle_dec _ _); nra).
  assert (R0 : 0 <= sqrt x) by apply sqrt_pos. pose proof (sqrt_sqrt x X) as SS.
  assert (G : forall p q : R, 0 <= q -> p * p <= q * q -> p <= q) by (intros; apply Rsqr_incr_0_var; unfold Rsqr;
    assumption).
  repeat match goal with H : (_ <= _)%Z |- _ => apply IZR_le in H end. rewrite !mult_IZR in *. split.
  - apply G; [now apply Rmult_le_pos; lra |].
    replace (sqrt x * IZR u * (sqrt x * IZR u)) with (x * IZR u * IZR u) by (rewrite <- SS at 1; ring).
    apply Rle_trans with (IZR a' * IZR u); [assumption |]. apply Rmult_le_compat_r; lra.
  - apply G; [assumption |]. replace (sqrt x * IZR u * (sqrt x * IZR u)) with (x * IZR u * IZR u) by (rewrite <- SS
    at 1; ring).
    apply Rle_trans with (IZR b * IZR u); [| assumption]. apply Rmult_le_compat_r; lra.
Qed.

Lemma cube_monotone p q : p * p * p <= q * q * q -> p <= q.
Proof.
  intros H. destruct (Rle_lt_dec p q); trivial. exfalso.
  assert (A : 0 < (p - q) * (p - q)) by (apply Rmult_lt_0_compat; lra). pose proof (Rle_0_sqr (p + q)) as B.
    unfold Rsqr in B.
  assert (C : 0 < (p - q) * (p * p + p * q + q * q)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma cube_root_holds e x c : holds u e x -> c * c * c = x -> holds u (cube_root root_hint u e) c.
Proof.
  destruct e as [[a b] |]; simpl; trivial. intros [A B] X. pose proof unit_above as Q. unfold S in Q.
  set (r := root_hint 3 (a * u * u)). set (s0 := root_hint 3 (b * u * u)).
  set (s := if (b * u * u <=? cube s0)%Z then s0 else (s0 + 1)%Z).
  destruct ((cube r <=? a * u * u) && (b * u * u <=? cube s))%Z eqn:E; simpl; trivial.
  apply andb_prop in E as [E F]. rewrite Z.leb_le in *. apply IZR_le in E, F. unfold cube in *.
    rewrite !mult_IZR in *.
  assert (V : c * IZR u * (c * IZR u) * (c * IZR u) = x * IZR u * IZR u * IZR u) by (rewrite <- X; ring).
  assert (W : 0 < IZR u * IZR u) by nra.
  split; apply cube_monotone; rewrite V.
  - apply Rle_trans with (IZR a * IZR u * IZR u); [assumption |]. rewrite !Rmult_assoc in *. nra.
  - apply Rle_trans with (IZR b * IZR u * IZR u); [| assumption]. rewrite !Rmult_assoc in *. nra.
Qed.

End Unit.

(* ---- other units ---- *)

Lemma finer_holds u m e x : (0 < m)%Z -> holds u e x -> holds (u * m) (finer m e) x.
Proof.
  intros P. destruct e as [[a b] |]; simpl; trivial. intros []. apply IZR_lt in P. rewrite !mult_IZR. split; nra.
Qed.

Lemma coarser_holds u m e x : (0 < m)%Z -> holds (u * m) e x -> holds u (over m e) x.
Proof.
  intros P. destruct e as [[a b] |]; simpl; trivial. rewrite mult_IZR. intros [].
    split; [apply floor_below | apply ceil_above]; trivial; lra.
Qed.

Lemma two_to_power h : IZR (two_to h) = 2 ^ h.
Proof. induction h; simpl; [reflexivity |]. change (IZR (2 * two_to h) = 2 * 2 ^ h). now rewrite mult_IZR, IHh. Qed.

Lemma two_to_above h : (0 < two_to h)%Z.
Proof. induction h; cbn [two_to]; lia. Qed.

(* ---- cosine ---- *)

Lemma next_even u a k m t : (0 < u)%Z -> m = (2 * Z.of_nat k)%Z -> forall sq, holds u sq (a * a) ->
  holds u t (a ^ (2 * k) / INR (fact (2 * k))) ->
  holds u (over ((m + 1) * (m + 2)) (mul most u t sq)) (a ^ (2 * (k + 1)) / INR (fact (2 * (k + 1)))).
Proof.
  intros U -> sq Q T.
  replace (a ^ (2 * (k + 1)) / INR (fact (2 * (k + 1)))) with
    (a ^ (2 * k) / INR (fact (2 * k)) * (a * a) / IZR ((2 * Z.of_nat k + 1) * (2 * Z.of_nat k + 2))).
  - apply over_holds; [nia |]. now apply mul_holds.
  - replace (2 * (k + 1))%nat with (S (S (2 * k))) by lia. rewrite !fact_simpl, !mult_INR.
    assert (E : IZR ((2 * Z.of_nat k + 1) * (2 * Z.of_nat k + 2)) = INR (S (S (2 * k))) * INR (S (2 * k))).
    { rewrite !INR_IZR_INZ, <- mult_IZR. f_equal. lia. }
    rewrite E. cbn [pow]. field. repeat split; try apply INR_fact_neq_0; apply not_0_INR; lia.
Qed.

Lemma cos_term_plus a k : Nat.Even k -> cos_term a k = a ^ (2 * k) / INR (fact (2 * k)).
Proof. intros [j ->]. unfold cos_term. rewrite pow_1_even. ring. Qed.

Lemma cos_term_minus a k : Nat.Even k -> cos_term a (k + 1) = - (a ^ (2 * (k + 1)) / INR (fact (2 * (k + 1)))).
Proof. intros [j ->]. unfold cos_term. replace (2 * j + 1)%nat with (S (2 * j)) by lia. rewrite pow_1_odd. ring. Qed.

Lemma cosine_terms_hold u a n : (0 < u)%Z -> -2 <= a <= 2 -> forall k m sq t s,
  Nat.Even k -> m = (2 * Z.of_nat k)%Z ->
  holds u sq (a * a) -> holds u t (a ^ (2 * k) / INR (fact (2 * k))) -> holds u s (cos_approx a k) ->
  holds u (cosine_terms most u sq n m t s) (cos a).
Proof.
  intros U A. induction n as [| n IH]; intros k m sq t s V M Q T F; cbn [cosine_terms]; cbv zeta;
    set (t1 := over ((m + 1) * (m + 2)) (mul most u t sq)); set (s1 := sub s t1);
    set (t2 := over ((m + 3) * (m + 4)) (mul most u t1 sq)); set (s2 := add s1 t2);
    assert (T1 : holds u t1 (a ^ (2 * (k + 1)) / INR (fact (2 * (k + 1))))) by (now apply next_even);
    assert (T2 : holds u t2 (a ^ (2 * (k + 2)) / INR (fact (2 * (k + 2)))))
      by (unfold t2; replace ((m + 3) * (m + 4))%Z with ((m + 2 + 1) * (m + 2 + 2))%Z by ring;
          replace (k + 2)%nat with (k + 1 + 1)%nat by lia; apply next_even; trivial; lia);
    assert (F1 : holds u s1 (cos_approx a (k + 1)))
      by (unfold cos_approx; replace (k + 1)%nat with (S k) by lia; rewrite tech5;
        replace (S k) with (k + 1)%nat by lia;
          rewrite cos_term_minus by assumption; now apply sub_holds);
    assert (F2 : holds u s2 (cos_approx a (k + 2)))
      by (unfold cos_approx; replace (k + 2)%nat with (S (k + 1)) by lia; rewrite tech5;
        replace (S (k + 1)) with (k + 2)%nat by lia;
          rewrite (cos_term_plus a (k + 2)) by (destruct V as [j ->]; exists (j + 1)%nat; lia); now apply add_holds).
  - destruct V as [j ->]. destruct (pre_cos_bound a j) as [L H]; [lra | lra |].
    replace (2 * (j + 1))%nat with (2 * j + 2)%nat in H by lia.
    apply (join_holds u U _ _ _ _ _ F1 F2). now split.
  - apply (IH (k + 2)%nat); trivial; [| lia]. destruct V as [j ->]. exists (j + 1)%nat. lia.
Qed.

Lemma small_cosine_holds u e a : (0 < u)%Z -> holds u e a -> holds u (small_cosine most u e) (cos a).
Proof.
  intros U H. destruct e as [[c d] |]; [| exact I]. unfold small_cosine.
  destruct ((- (2 * u) <=? c) && (d <=? 2 * u))%Z eqn:E; [| exact I]. apply andb_prop in E as [C D].
    rewrite Z.leb_le in C, D.
  apply IZR_le in C, D. rewrite opp_IZR, mult_IZR in *. pose proof (IZR_lt _ _ U). simpl in H.
  apply (cosine_terms_hold u a _ U) with (k := 0%nat); trivial.
  - split; apply Rmult_le_reg_r with (IZR u); lra.
  - exists 0%nat. reflexivity.
  - now apply mul_holds.
  - replace (a ^ (2 * 0) / INR (fact (2 * 0))) with (IZR 1) by (simpl; field). now apply whole_holds.
  - replace (cos_approx a 0) with (IZR 1) by (unfold cos_approx, cos_term; simpl; field). now apply whole_holds.
Qed.

Lemma doubled_cosine_holds u h : (0 < u)%Z -> forall c y,
  holds u c (cos y) -> holds u (doubled_cosine most u h c) (cos (2 ^ h * y)).
Proof.
  intros U. induction h as [| h IH]; intros c y H; cbn [doubled_cosine].
  - simpl. now rewrite Rmult_1_l.
  - replace (2 ^ Datatypes.S h * y) with (2 ^ h * (2 * y)) by (simpl; ring). apply IH. rewrite cos_2a_cos.
    replace (2 * cos y * cos y - 1) with (cos y * cos y + cos y * cos y - IZR 1) by (simpl; ring).
    apply sub_holds; trivial; [| now apply whole_holds]. now apply add_holds; trivial; apply mul_holds.
Qed.

Lemma more_above h : (0 < two_to h * two_to h * more_bits)%Z.
Proof. pose proof (two_to_above h). unfold more_bits. nia. Qed.

Lemma within_one_holds u e x : (0 < u)%Z -> holds u e x -> -1 <= x <= 1 -> holds u (within_one u e) x.
Proof.
  intros U H B. destruct e as [[a b] |]; [| exact I]. pose proof (IZR_lt _ _ U). simpl in *.
  rewrite max_IZR, min_IZR, opp_IZR. split; [apply Rmax_lub | apply Rmin_glb]; nra.
Qed.

Lemma cosine_holds u e x : (0 < u)%Z -> holds u e x -> holds u (cosine most u e) (cos x).
Proof.
  intros U H. unfold cosine. set (h := halvings 40 (extent e) u). set (m := (two_to h * two_to h * more_bits)%Z).
  assert (M : (0 < m)%Z) by apply more_above. assert (V : (0 < u * m)%Z) by nia.
  apply within_one_holds; [exact U | | pose proof (COS_bound x); lra]. apply coarser_holds; trivial.
  replace x with (2 ^ h * (x / IZR (two_to h))).
  - apply doubled_cosine_holds, small_cosine_holds, over_holds; trivial; [apply two_to_above | now apply finer_holds].
  - rewrite two_to_power. field. apply pow_nonzero. lra.
Qed.

Lemma half_pi_below x : 0 < x < 2 -> 0 < cos x -> x < PI / 2.
Proof. exact (PI2_lower_bound x). Qed.

Lemma pi_holds u : (0 < u)%Z -> holds u (pi_at most pi_hint u) PI.
Proof.
  intros U. unfold pi_at. set (l := pi_hint u). set (v := (2 * u * half_more)%Z).
  destruct ((0 <? l) && (l <? 4 * u) && (sign_of (cosine most v (whole half_more l)) =? 1)
    && (sign_of (cosine most v (whole half_more (l + 1))) =? -1))%Z eqn:E; [| exact I].
  repeat (apply andb_prop in E as [E ?]). rewrite Z.ltb_lt, ?Z.eqb_eq in *.
  assert (V : (0 < v)%Z) by (unfold v, half_more; lia). pose proof (IZR_lt _ _ U) as Q.
  assert (P : forall z, holds v (whole half_more z) (IZR z / (2 * IZR u))).
  { intros z. unfold whole, holds, v. rewrite !mult_IZR.
    assert (G : IZR z / (2 * IZR u) * (2 * IZR u * IZR half_more) = IZR z * IZR half_more) by (field; lra). lra. }
  match goal with H : sign_of _ = 1%Z, K : sign_of _ = (-1)%Z |- _ =>
    apply (sign_positive v V _ _ (cosine_holds v _ _ V (P l))) in H;
      apply (sign_negative v V _ _ (cosine_holds v _ _ V (P (l + 1)%Z))) in K end.
  repeat match goal with H : (_ < _)%Z |- _ => apply IZR_lt in H end. rewrite mult_IZR in *.
  assert (D : forall z : R, z / (2 * IZR u) * (2 * IZR u) = z) by (intros; field; lra).
  assert (L : IZR l / (2 * IZR u) < PI / 2).
  { apply half_pi_below; trivial. split; apply Rmult_lt_reg_r with (2 * IZR u); rewrite ?D; lra. }
  assert (H' : PI / 2 < IZR (l + 1) / (2 * IZR u)).
  { apply Rnot_le_lt. intros K. assert (0 <= cos (IZR (l + 1) / (2 * IZR u))); [| lra]. apply cos_ge_0; [| exact K].
    pose proof PI_RGT_0. assert (0 <= IZR (l + 1) / (2 * IZR u)); [| lra].
      apply Rmult_le_reg_r with (2 * IZR u); [lra |].
    rewrite D, plus_IZR. lra. }
  simpl. apply Rmult_lt_compat_r with (r := 2 * IZR u) in L; [| lra].
    apply Rmult_lt_compat_r with (r := 2 * IZR u) in H'; [| lra].
  rewrite D in L, H'. split; lra.
Qed.

Lemma sine_holds u pi2 e x : (0 < u)%Z -> holds u pi2 (PI / 2) -> holds u e x -> holds u (sine most u pi2 e) (sin x).
Proof. intros U P H. unfold sine. rewrite <- cos_shift. now apply cosine_holds, sub_holds. Qed.

(* ---- exponentials ---- *)

Definition exp_term (y : R) (k : nat) : R := y ^ k / INR (fact k).

Lemma exp_term_next y k : exp_term y (Datatypes.S k) = exp_term y k * y / INR (Datatypes.S k).
Proof.
  unfold exp_term. rewrite fact_simpl, mult_INR. cbn [pow]. field.
    split; [apply INR_fact_neq_0 | apply not_0_INR; lia].
Qed.

Lemma exp_term_positive y k : 0 <= y -> 0 <= exp_term y k.
Proof.
  intros Y. unfold exp_term. apply Rmult_le_pos; [now apply pow_le |]. left. apply Rinv_0_lt_compat, INR_fact_lt_0.
Qed.

Lemma exp_bounds y n : 0 <= y <= 1 ->
  sum_f_R0 (tg_alt (exp_term y)) (Datatypes.S (2 * n)) <= exp (- y) <= sum_f_R0 (tg_alt (exp_term y)) (2 * n).
Proof.
  intros Y. apply alternated_series_ineq.
  - intros k. rewrite exp_term_next. pose proof (exp_term_positive y k (proj1 Y)) as T.
    assert (K : 1 <= INR (Datatypes.S k)) by (rewrite S_INR; pose proof (pos_INR k); lra).
    apply Rmult_le_reg_r with (INR (Datatypes.S k)); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra.
      rewrite Rmult_1_r.
    apply Rmult_le_compat_l; lra.
  - exact (cv_speed_pow_fact y).
  - intros eps He. destruct (E1_cvg (- y) eps He) as [N H]. exists N. intros k Hk. specialize (H k Hk).
    replace (sum_f_R0 (tg_alt (exp_term y)) k) with (E1 (- y) k); [exact H |]. unfold E1. apply sum_eq. intros i _.
    unfold tg_alt, exp_term. replace (- y) with (-1 * y) by ring. rewrite Rpow_mult_distr. unfold Rdiv. ring.
Qed.

Lemma next_term u y z k t : (0 < u)%Z -> IZR z = y * IZR u -> holds u t (exp_term y k) ->
  holds u (over (Z.of_nat k + 1) (mul most u t (Some (z, z)))) (exp_term y (Datatypes.S k)).
Proof.
  intros U Z T. rewrite exp_term_next. replace (INR (Datatypes.S k)) with (IZR (Z.of_nat k + 1)) by (rewrite
    INR_IZR_INZ; f_equal; lia).
  apply over_holds; trivial; [lia |]. apply mul_holds; trivial. simpl. lra.
Qed.

Lemma exp_terms_hold u y z n : (0 < u)%Z -> IZR z = y * IZR u -> 0 <= y <= 1 -> forall k m t s,
  Nat.Even k -> m = Z.of_nat k ->
  holds u t (exp_term y k) -> holds u s (sum_f_R0 (tg_alt (exp_term y)) k) ->
    holds u (exp_terms most u z n m t s) (exp (- y)).
Proof.
  intros U Z Y. induction n as [| n IH]; intros k m t s V M T F; cbn [exp_terms]; cbv zeta;
    set (t1 := over (m + 1) (mul most u t (Some (z, z)))); set (s1 := sub s t1);
    assert (T1 : holds u t1 (exp_term y (Datatypes.S k))) by (unfold t1; rewrite M; now apply next_term);
    assert (F1 : holds u s1 (sum_f_R0 (tg_alt (exp_term y)) (Datatypes.S k)))
      by (rewrite tech5; unfold tg_alt at 2; destruct V as [j ->]; rewrite pow_1_odd;
          match goal with |- holds _ _ (?p + -1 * ?q) => replace (p + -1 * q) with (p - q) by ring end;
            now apply sub_holds).
  - destruct V as [j ->]. destruct (exp_bounds y j Y) as [L H].
    apply (join_holds u U _ _ _ _ _ F1 F). now split.
  - apply (IH (k + 2)%nat); trivial; [destruct V as [j ->]; exists (j + 1)%nat; lia | lia | |];
      replace (k + 2)%nat with (Datatypes.S (Datatypes.S k)) by lia;
        replace (m + 2)%Z with (Z.of_nat (Datatypes.S k) + 1)%Z by lia.
    + now apply next_term.
    + rewrite tech5. apply add_holds; trivial. unfold tg_alt. destruct V as [j ->].
      replace (Datatypes.S (Datatypes.S (2 * j))) with (2 * (j + 1))%nat by lia. rewrite pow_1_even, Rmult_1_l.
      replace (2 * (j + 1))%nat with (Datatypes.S (Datatypes.S (2 * j))) by lia. now apply next_term.
Qed.

Lemma small_exp_holds u z : (0 < u)%Z -> holds u (small_exp most u z) (exp (IZR z / IZR u)).
Proof.
  intros U. unfold small_exp. destruct (Z.leb_spec (Z.abs z) u) as [L | L]; [| exact I].
  pose proof (IZR_lt _ _ U) as Q. apply IZR_le in L. set (y := IZR (Z.abs z) / IZR u).
  assert (E : IZR (Z.abs z) = y * IZR u) by (unfold y; field; lra).
  assert (A : 0 <= IZR (Z.abs z)) by (apply IZR_le; lia).
  assert (Y : 0 <= y <= 1) by (split; apply Rmult_le_reg_r with (IZR u); lra).
  assert (H : holds u (exp_terms most u (Z.abs z) (pairs_of_terms fuel (u * u)) 0 (whole u 1) (whole u 1)) (exp (-
    y))).
  { apply (exp_terms_hold u y _ _ U E Y 0%nat); [exists 0%nat; reflexivity | reflexivity | |].
    - replace (exp_term y 0) with (IZR 1) by (unfold exp_term; simpl; field). now apply whole_holds.
    - replace (sum_f_R0 (tg_alt (exp_term y)) 0) with (IZR 1) by (unfold tg_alt, exp_term; simpl; field).
      now apply whole_holds. }
  destruct (Z.ltb_spec 0 z) as [P | P].
  - replace (IZR z / IZR u) with y by (unfold y; rewrite Z.abs_eq by lia; reflexivity).
    replace (exp y) with (/ exp (- y)) by (rewrite exp_Ropp, Rinv_inv; reflexivity). now apply inverse_holds.
  - replace (IZR z / IZR u) with (- y); [exact H |]. unfold y. rewrite Z.abs_neq, opp_IZR by lia. field. lra.
Qed.

Lemma squared_holds u h : (0 < u)%Z -> forall e y,
  holds u e (exp y) -> holds u (squared most u h e) (exp (2 ^ h * y)).
Proof.
  intros U. induction h as [| h IH]; intros e y H; cbn [squared].
  - simpl. now rewrite Rmult_1_l.
  - replace (2 ^ Datatypes.S h * y) with (2 ^ h * (y + y)) by (simpl; ring). apply IH. rewrite exp_plus.
    now apply mul_holds.
Qed.

Lemma exp_monotone x y : x <= y -> exp x <= exp y.
Proof. intros [H | ->]; [left; now apply exp_increasing | right; reflexivity]. Qed.

Lemma exponential_holds u e x : (0 < u)%Z -> holds u e x -> holds u (exponential most u e) (exp x).
Proof.
  intros U H. unfold exponential. set (h := halvings 24 (extent e) u). set (m := (two_to h * two_to h * more_bits)%Z).
  assert (M : (0 < m)%Z) by apply more_above. assert (V : (0 < u * m)%Z) by nia.
  assert (K : holds (u * m) (over (two_to h) (finer m e)) (x / IZR (two_to h)))
    by (apply over_holds; trivial; [apply two_to_above | now apply finer_holds]).
  destruct (over (two_to h) (finer m e)) as [[a b] |]; [| exact I].
  pose proof (small_exp_holds (u * m) a V) as A. pose proof (small_exp_holds (u * m) b V) as B.
  apply coarser_holds; trivial. replace x with (2 ^ h * (x / IZR (two_to h))).
  - apply squared_holds; trivial. simpl in K. pose proof (IZR_lt _ _ V) as Q. set (y := x / IZR (two_to h)) in *.
    assert (La : exp (IZR a / IZR (u * m)) <= exp y).
    { apply exp_monotone. apply Rmult_le_reg_r with (IZR (u * m)); [exact Q |]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l; lra. }
    assert (Hb : exp y <= exp (IZR b / IZR (u * m))).
    { apply exp_monotone. apply Rmult_le_reg_r with (IZR (u * m)); [exact Q |]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l; lra. }
    apply (join_holds _ V _ _ _ _ _ A B). now split.
  - rewrite two_to_power. field. apply pow_nonzero. lra.
Qed.

(* ---- roots of polynomials ---- *)

Lemma homogeneous_value f n d : (0 < d)%Z -> 0 < IZR (snd (homogeneous f n d)) /\
  IZR (fst (homogeneous f n d)) * IZR d = at_ f (IZR n / IZR d) * IZR (snd (homogeneous f n d)).
Proof.
  intros D. pose proof (IZR_lt _ _ D) as Q. induction f as [| c f [IP IH]]; simpl; [lra |].
  destruct (homogeneous f n d) as [v w]. cbn [fst snd] in *. rewrite plus_IZR, !mult_IZR.
    split; [now apply Rmult_lt_0_compat |].
  transitivity (IZR c * IZR w * IZR d + IZR n * (IZR v * IZR d)); [ring |]. rewrite IH. field. lra.
Qed.

Lemma sign_at_positive f n d : (0 < d)%Z -> sign_at f n d = 1%Z -> 0 < at_ f (IZR n / IZR d).
Proof.
  intros D E. destruct (homogeneous_value f n d D) as [P V]. unfold sign_at in E. apply Z.sgn_pos_iff in E.
    apply IZR_lt in E, D.
  apply Rmult_lt_reg_r with (IZR (snd (homogeneous f n d))); nra.
Qed.

Lemma sign_at_negative f n d : (0 < d)%Z -> sign_at f n d = (-1)%Z -> at_ f (IZR n / IZR d) < 0.
Proof.
  intros D E. destruct (homogeneous_value f n d D) as [P V]. unfold sign_at in E. apply Z.sgn_neg_iff in E.
    apply IZR_lt in E, D.
  apply Rmult_lt_reg_r with (IZR (snd (homogeneous f n d))); nra.
Qed.

Lemma sign_at_zero f n d : (0 < d)%Z -> sign_at f n d = 0%Z -> at_ f (IZR n / IZR d) = 0.
Proof.
  intros D E. destruct (homogeneous_value f n d D) as [P V]. unfold sign_at in E.
    apply (proj1 (Z.sgn_null_iff _)) in E. rewrite E in V.
  apply Rmult_eq_reg_r with (IZR (snd (homogeneous f n d))); lra.
Qed.

Lemma sign_at_cases f n d : sign_at f n d = 1%Z \/ sign_at f n d = (-1)%Z \/ sign_at f n d = 0%Z.
Proof. unfold sign_at. destruct (fst (homogeneous f n d)); simpl; auto. Qed.

Fixpoint slope (f : list Z) (x : R) : R := match f with [] => 0 | c :: g => at_ g x + x * slope g x end.

Lemma slope_derives f x : derivable_pt_lim (at_ f) x (slope f x).
Proof.
  induction f as [| c f IH]; simpl; [apply derivable_pt_lim_const |].
  replace (at_ f x + x * slope f x) with (0 + (1 * at_ f x + x * slope f x)) by ring.
  apply derivable_pt_lim_plus; [apply derivable_pt_lim_const |].
  apply (derivable_pt_lim_mult id (at_ f)); [apply derivable_pt_lim_id | exact IH].
Qed.

Lemma at_continuous f : continuity (at_ f).
Proof. intros x. apply derivable_continuous_pt. exists (slope f x). apply slope_derives. Qed.

Lemma derivative_value f x : at_ (derivative f) x = slope f x.
Proof.
  destruct f as [| c f]; [reflexivity |]. cbn [derivative slope].
  assert (K : forall k, at_ (derivative_from k f) x = IZR k * at_ f x + x * slope f x).
  { clear c. induction f as [| c f IH]; intros k; cbn [derivative_from at_ slope]; [ring |].
    rewrite IH, mult_IZR, plus_IZR. simpl. ring. }
  rewrite K. simpl. ring.
Qed.

Lemma horner_holds u f e x : (0 < u)%Z -> holds u e x -> holds u (horner most u f e) (at_ f x).
Proof.
  intros U H. induction f as [| c f IH]; cbn [horner at_]; [apply (whole_holds u 0) |].
  apply add_holds; trivial; [now apply whole_holds | now apply mul_holds].
Qed.

Definition lo_end (r : bracket) : R := IZR (lo_num r) / IZR (lo_den r).
Definition hi_end (r : bracket) : R := IZR (hi_num r) / IZR (hi_den r).
Definition root_of (r : bracket) (x : R) : Prop := lo_end r < x < hi_end r /\ at_ (coefficients r) x = 0.

Lemma single_parts u r : (0 < u)%Z -> is_single most u r = true ->
  (0 < lo_den r)%Z /\ (0 < hi_den r)%Z /\ lo_end r < hi_end r /\
  at_ (coefficients r) (lo_end r) * at_ (coefficients r) (hi_end r) < 0 /\
  forall x, lo_end r <= x <= hi_end r -> slope (coefficients r) x <> 0.
Proof.
  intros U E. unfold is_single in E. repeat (apply andb_prop in E as [E ?]).
  rewrite Z.ltb_lt, ?Z.eqb_eq in *. match goal with H : negb _ = true |- _ => apply negb_true_iff, Z.eqb_neq in H;
    rename H into N end.
  match goal with H : (_ * _ = -1)%Z |- _ => rename H into G end.
    match goal with H : (_ * _ < _)%Z |- _ => rename H into O end.
  assert (P : (0 < lo_den r)%Z) by assumption. assert (Q : (0 < hi_den r)%Z) by assumption.
  pose proof (IZR_lt _ _ P) as P'. pose proof (IZR_lt _ _ Q) as Q'.
  split; [exact P | split; [exact Q | split; [| split]]].
  - apply IZR_lt in O. rewrite !mult_IZR in O. unfold lo_end, hi_end.
    apply Rmult_lt_reg_r with (IZR (lo_den r) * IZR (hi_den r)); [nra |].
    replace (IZR (lo_num r) / IZR (lo_den r) * (IZR (lo_den r) * IZR (hi_den r))) with (IZR (lo_num r) * IZR (hi_den
      r)) by (field; lra).
    replace (IZR (hi_num r) / IZR (hi_den r) * (IZR (lo_den r) * IZR (hi_den r))) with (IZR (hi_num r) * IZR (lo_den
      r)) by (field; lra). exact O.
  - unfold lo_end, hi_end.
    destruct (sign_at_cases (coefficients r) (lo_num r) (lo_den r)) as [A | [A | A]],
      (sign_at_cases (coefficients r) (hi_num r) (hi_den r)) as [B | [B | B]]; rewrite A, B in G; try discriminate G.
    + pose proof (sign_at_positive _ _ _ P A). pose proof (sign_at_negative _ _ _ Q B). nra.
    + pose proof (sign_at_negative _ _ _ P A). pose proof (sign_at_positive _ _ _ Q B). nra.
  - intros x X. rewrite <- derivative_value. apply (sign_not_zero u U) with (2 := N). apply horner_holds; trivial.
    apply join_holds with (x := lo_end r) (y := hi_end r); trivial; now apply fraction_holds.
Qed.

Theorem root_exists u r : (0 < u)%Z -> is_single most u r = true -> exists x, root_of r x.
Proof.
  intros U E. destruct (single_parts u r U E) as (_ & _ & O & G & _).
  destruct (bracket_root (at_ (coefficients r)) _ _ (at_continuous _) O G) as [x [X Z]]. exists x. now split.
Qed.

Theorem root_unique u r x y : (0 < u)%Z -> is_single most u r = true -> root_of r x -> root_of r y -> x = y.
Proof.
  intros U E [X Fx] [Y Fy]. destruct (single_parts u r U E) as (_ & _ & O & _ & N).
  apply (bracket_one_root (at_ (coefficients r)) (slope (coefficients r)) (lo_end r) (hi_end r)); trivial; try lra.
  intros c _. apply slope_derives.
Qed.

Lemma enclose_root_holds u r l x : (0 < u)%Z -> is_single most u r = true -> root_of r x ->
  holds u (enclose_root u r l) x.
Proof.
  intros U E [X Fx]. destruct (single_parts u r U E) as (P & Q & O & _ & N). unfold enclose_root.
  destruct ((lo_num r * u <=? l * lo_den r) && ((l + 1) * hi_den r <=? hi_num r * u)
    && (sign_at (coefficients r) l u * sign_at (coefficients r) (l + 1) u <=? 0))%Z eqn:B; [| exact I].
  apply andb_prop in B as [B G]. apply andb_prop in B as [A B]. rewrite Z.leb_le in *.
  apply IZR_le in A, B. rewrite !mult_IZR in A, B. pose proof (IZR_lt _ _ P) as P'. pose proof (IZR_lt _ _ Q) as Q'.
    pose proof (IZR_lt _ _ U) as U'.
  set (p := IZR l / IZR u). set (q := IZR (l + 1) / IZR u).
  assert (Pu : p * IZR u = IZR l) by (unfold p; field; lra).
    assert (Qu : q * IZR u = IZR (l + 1)) by (unfold q; field; lra).
  assert (L0 : lo_end r * IZR (lo_den r) = IZR (lo_num r)) by (unfold lo_end; field; lra).
  assert (H0 : hi_end r * IZR (hi_den r) = IZR (hi_num r)) by (unfold hi_end; field; lra).
  assert (Lp : lo_end r <= p) by (apply Rmult_le_reg_r with (IZR (lo_den r) * IZR u); nra).
  assert (Hq : q <= hi_end r) by (apply Rmult_le_reg_r with (IZR (hi_den r) * IZR u); nra).
  assert (pq : p <= q) by (apply Rmult_le_reg_r with (IZR u); rewrite ?Pu, ?Qu, ?plus_IZR; lra).
  assert (Z0 : at_ (coefficients r) p * at_ (coefficients r) q <= 0).
  { unfold p, q. destruct (sign_at_cases (coefficients r) l u) as [S1 | [S1 | S1]],
    (sign_at_cases (coefficients r) (l + 1) u) as [S2 | [S2 | S2]];
      rewrite S1, S2 in G; try (exfalso; lia);
      try apply (sign_at_positive _ _ _ U) in S1; try apply (sign_at_negative _ _ _ U) in S1;
        try apply (sign_at_zero _ _ _ U) in S1;
      try apply (sign_at_positive _ _ _ U) in S2; try apply (sign_at_negative _ _ _ U) in S2;
        try apply (sign_at_zero _ _ _ U) in S2; nra. }
  destruct (IVT_cor (at_ (coefficients r)) p q (at_continuous _) pq Z0) as [z [[Z1 Z2] Fz]].
  assert (z = x).
  { apply (bracket_one_root (at_ (coefficients r)) (slope (coefficients r)) (lo_end r) (hi_end r)); trivial; try lra.
    intros c _. apply slope_derives. }
  subst z. simpl. rewrite <- Pu, <- Qu. split; nra.
Qed.

End Sound.
