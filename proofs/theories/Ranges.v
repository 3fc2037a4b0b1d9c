(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Ranges with ends among -1, 0, 1 and none, from the form of an expression [RANGE-1]: src/stream/expr.c,
  function
   by function. *)
From Coq Require Import Reals ZArith Lra Lia Psatz List Bool.
Open Scope R_scope.
Open Scope Z_scope.

Definition none : Z := 9.
Definition range : Type := (Z * Z)%type.
Definition below (l : Z) (x : R) : Prop := l = - none \/ (IZR l <= x)%R.
Definition above (h : Z) (x : R) : Prop := h = none \/ (x <= IZR h)%R.
Definition has (a : range) (x : R) : Prop := below (fst a) x /\ above (snd a) x.
(* The ends that occur. *)
Definition ends (a : range) : Prop := In (fst a) (- none :: -1 :: 0 :: 1 :: nil) /\ In (snd a) (-1 :: 0 :: 1 :: none
  :: nil).

Definition least (a b : Z) : Z := if a <? b then a else b.
Definition most (a b : Z) : Z := if b <? a then a else b.
Definition make (lo hi : Z) : range :=
  ((if lo <? -1 then - none else least lo 1), (if 1 <? hi then none else most hi (-1))).
Definition anything : range := (- none, none).
Definition neg (a : range) : range := make (- snd a) (- fst a).
Definition add (a b : range) : range :=
  make (if (fst a =? - none) || (fst b =? - none) then - none else fst a + fst b)
       (if (snd a =? none) || (snd b =? none) then none else snd a + snd b).
Definition is_unit (a : range) : bool := (-1 <=? fst a) && (snd a <=? 1).
(* Two times turned round at most; n is how often it still may be. *)
Fixpoint mul (n : nat) (a b : range) : range :=
  if is_unit a && is_unit b then
    let p := fst a * fst b in let q := fst a * snd b in let r := snd a * fst b in let s := snd a * snd b in
    make (least (least p q) (least r s)) (most (most p q) (most r s))
  else match n with
  | O => anything
  | S m => if (snd a <=? 0) && (fst a <? 0) then neg (mul m (neg a) b)
    else if (snd b <=? 0) && (fst b <? 0) then neg (mul m a (neg b))
    else if (0 <=? fst a) && (0 <=? fst b) then make (fst a * fst b) none else anything
  end.
Definition quotient (a b : range) : range :=
  if fst b <? 0 then anything else
  let shrinks := 1 <=? fst b in
  make (if 0 <=? fst a then 0 else if shrinks && (-1 <=? fst a) then -1 else - none)
       (if snd a <=? 0 then 0 else if shrinks && (snd a <=? 1) then 1 else none).
Definition div (a b : range) : range :=
  if (snd b <=? 0) && (fst b <? 0) then neg (quotient a (neg b)) else quotient a b.
Definition abs (a : range) : range :=
  if 0 <=? fst a then a else if snd a <=? 0 then neg a else make 0 (if is_unit a then 1 else none).
Definition power (a : range) (n : Z) : range :=
  if n =? 0 then make 1 1 else
  let base := if Z.odd n then a else abs a in if n <? 0 then div (make 1 1) base else base.
Definition meet (a b : range) : range := make (most (fst a) (fst b)) (least (snd a) (snd b)).
Definition of_exp (a : range) : range := make (if 0 <=? fst a then 1 else 0) (if snd a <=? 0 then 1 else none).
Definition of_log (a : range) : range := make (if 1 <=? fst a then 0 else - none) (if snd a <=? 1 then 0 else none).
Definition of_sign (a : range) : range := make (if 0 <=? fst a then 0 else - none) (if snd a <=? 0 then 0 else none).
Definition of_root (a : range) : range := meet (make 0 none) (make (fst a) (if 0 <=? snd a then snd a else 0)).
Definition smaller (a b : range) : range := make (least (fst a) (fst b)) (least (snd a) (snd b)).
Definition larger (a b : range) : range := make (most (fst a) (fst b)) (most (snd a) (snd b)).

(* make only weakens, and ends are always among those. *)
Theorem make_ends lo hi : ends (make lo hi).
Proof.
  unfold ends, make, least, most, none. cbn [fst snd].
  destruct (Z.ltb_spec lo (-1)); destruct (Z.ltb_spec lo 1); destruct (Z.ltb_spec 1 hi); destruct (Z.ltb_spec (-1)
    hi); simpl; lia.
Qed.

Lemma make_has lo hi x : (lo < -1 \/ (IZR lo <= x)%R) -> (1 < hi \/ (x <= IZR hi)%R) -> has (make lo hi) x.
Proof.
  intros L H. unfold has, make, below, above, least, most. cbn [fst snd]. split.
  - destruct (Z.ltb_spec lo (-1)); [now left |]. right. destruct L as [L | L]; [lia |].
    destruct (Z.ltb_spec lo 1) as [I | I]; [exact L |]. apply IZR_le in I. lra.
  - destruct (Z.ltb_spec 1 hi); [now left |]. right. destruct H as [H | H]; [lia |].
    destruct (Z.ltb_spec (-1) hi) as [I | I]; [exact H |]. apply IZR_le in I. lra.
Qed.

Ltac ranges a :=
  let l := fresh in let h := fresh in destruct a as [l h];
  match goal with E : ends (l, h) |- _ => unfold ends in E; cbn [fst snd] in E;
    destruct E as [[<- | [<- | [<- | [<- | []]]]] [<- | [<- | [<- | [<- | []]]]]] end.
Ltac known H := unfold has, below, above, none in H; cbn [fst snd] in H;
  destruct H as [[H | H] [? | ?]]; try discriminate.

Theorem neg_has a x : has a x -> has (neg a) (- x).
Proof.
  intros [L H]. unfold neg. apply make_has; unfold below, above, none in *.
  - destruct H as [H | H]; [left; lia | right; rewrite opp_IZR; lra].
  - destruct L as [L | L]; [left; lia | right; rewrite opp_IZR; lra].
Qed.

Lemma neg_ends a : ends (neg a).
Proof. apply make_ends. Qed.

Theorem add_has a b x y : has a x -> has b y -> has (add a b) (x + y).
Proof.
  intros [L H] [K G]. unfold add. apply make_has; unfold below, above, none in *.
  - destruct (Z.eqb_spec (fst a) (-(9))); [left; simpl; lia |]. destruct (Z.eqb_spec (fst b) (-(9))); [left; simpl;
    lia |].
    right. simpl. rewrite plus_IZR. destruct L; [lia |]. destruct K; [lia |]. lra.
  - destruct (Z.eqb_spec (snd a) 9); [left; simpl; lia |]. destruct (Z.eqb_spec (snd b) 9); [left; simpl; lia |].
    right. simpl. rewrite plus_IZR. destruct H; [lia |]. destruct G; [lia |]. lra.
Qed.

Ltac finish := unfold has, below, above, none; cbn; split; first [left; reflexivity | right; lra | right; nra |
  exfalso; lra].

Theorem mul_has n a b x y : ends a -> ends b -> has a x -> has b y -> has (mul n a b) (x * y).
Proof.
  revert a b x y. induction n as [| m IH]; intros a b x y Ea Eb X Y; cbn [mul]; destruct (is_unit a && is_unit b)
    eqn:U.
  1, 3: clear - U Ea Eb X Y; ranges a; ranges b; try discriminate U; known X; known Y; clear U; finish.
  - split; now left.
  - destruct ((snd a <=? 0) && (fst a <? 0)).
    { replace (x * y)%R with (- (- x * y))%R by ring. apply neg_has, IH; [apply neg_ends | exact Eb | now apply
      neg_has | exact Y]. }
    destruct ((snd b <=? 0) && (fst b <? 0)).
    { replace (x * y)%R with (- (x * - y))%R by ring. apply neg_has, IH; [exact Ea | apply neg_ends | exact X | now
      apply neg_has]. }
    destruct ((0 <=? fst a) && (0 <=? fst b)) eqn:V; [| split; now left].
    clear - V Ea Eb X Y. ranges a; ranges b; try discriminate V; known X; known Y; clear V; finish.
Qed.

(* Three calls deep it is the function that calls itself without limit. *)
Theorem mul_settles a b : ends a -> ends b -> mul 4 a b = mul 3 a b.
Proof. intros Ea Eb. ranges a; ranges b; reflexivity. Qed.

Lemma quotient_has a b x y : ends a -> ends b -> has a x -> has b y -> y <> 0%R -> 0 <= fst b -> has (quotient a b)
  (x / y).
Proof.
  intros Ea Eb X Y N P. assert (Y0 : (0 < y)%R).
  { destruct Y as [[L | L] _]; [unfold none in L; lia |]. apply IZR_le in P. lra. }
  assert (E : x = (x / y * y)%R) by (field; lra). remember (x / y)%R as q. subst x.
  ranges a; ranges b; unfold none in P; cbn in P; try lia; known X; known Y; finish.
Qed.

Theorem div_has a b x y : ends a -> ends b -> has a x -> has b y -> y <> 0%R -> has (div a b) (x / y).
Proof.
  intros Ea Eb X Y N. unfold div. destruct ((snd b <=? 0) && (fst b <? 0)) eqn:V.
  - replace (x / y)%R with (- (x / - y))%R by (field; exact N). apply neg_has, quotient_has; [exact Ea | apply
    neg_ends | exact X | now apply neg_has | intros O; apply N; lra |].
    apply andb_true_iff in V. destruct V as [V W]. apply Z.leb_le in V. clear - V Eb. ranges b; unfold none in *; cbn
      in *; lia.
  - destruct (Z.ltb_spec (fst b) 0) as [S | S]; [| now apply quotient_has].
    unfold quotient. destruct (Z.ltb_spec (fst b) 0); [split; now left | lia].
Qed.

Theorem abs_has a x : ends a -> has a x -> has (abs a) (Rabs x).
Proof.
  intros Ea X. unfold Rabs. destruct (Rcase_abs x); ranges a; known X; try lra; finish.
Qed.

Lemma abs_ends a : ends a -> ends (abs a).
Proof. intros E. unfold abs. destruct (0 <=? fst a); [exact E |]. destruct (snd a <=? 0); apply make_ends. Qed.

Lemma has_odd_power a x k : ends a -> has a x -> has a (x ^ S (2 * k)).
Proof.
  intros Ea X. assert (S : (0 <= (x ^ k) * (x ^ k))%R) by nra.
  assert (P : (x ^ Datatypes.S (2 * k) = x * ((x ^ k) * (x ^ k)))%R) by (simpl; rewrite Nat.add_0_r, pow_add; ring).
  assert (G : (1 <= Rabs x -> 1 <= (x ^ k) * (x ^ k))%R).
  { intros H. rewrite <- Rabs_right by (apply Rle_ge; exact S). rewrite Rabs_mult, <- RPow_abs. pose proof
    (pow_R1_Rle _ k H). nra. }
  assert (L : (Rabs x <= 1 -> (x ^ k) * (x ^ k) <= 1)%R).
  { intros H. rewrite <- (Rabs_right ((x ^ k) * (x ^ k))) by (apply Rle_ge; exact S). rewrite Rabs_mult, <- RPow_abs.
    pose proof (pow_incr (Rabs x) 1 k (conj (Rabs_pos x) H)) as Q. rewrite pow1 in Q.
    pose proof (pow_le _ k (Rabs_pos x)). nra. }
  rewrite P. set (s := ((x ^ k) * (x ^ k))%R) in *. clearbody s. clear P.
  unfold Rabs in G, L. destruct (Rcase_abs x); destruct (Rle_or_lt 1 (- x)); destruct (Rle_or_lt 1 x); try lra;
    try specialize (G ltac:(lra)); try specialize (L ltac:(lra)); ranges a; known X; try lra; finish.
Qed.

Lemma has_even_power a x k : ends a -> has a x -> (0 < k)%nat -> has (abs a) (x ^ (2 * k)).
Proof.
  intros Ea X K. destruct k as [| k]; [lia |].
  replace (x ^ (2 * Datatypes.S k))%R with (Rabs x * Rabs x ^ Datatypes.S (2 * k))%R.
  2: { rewrite RPow_abs. rewrite <- Rabs_mult. replace (x * x ^ Datatypes.S (2 * k))%R with (x ^ (2 * Datatypes.S
    k))%R.
    - apply Rabs_right. replace (2 * Datatypes.S k)%nat with (Datatypes.S k + Datatypes.S k)%nat by lia. rewrite
      pow_add. apply Rle_ge; nra.
    - replace (2 * Datatypes.S k)%nat with (Datatypes.S (Datatypes.S (2 * k))) by lia. reflexivity. }
  pose proof (has_odd_power _ _ k (abs_ends a Ea) (abs_has _ _ Ea X)) as H. pose proof (abs_has _ _ Ea X) as A.
  pose proof (Rabs_pos x) as P. pose proof (pow_le _ (Datatypes.S (2 * k)) P) as Q.
  pose proof (pow_R1_Rle (Rabs x) (Datatypes.S (2 * k))) as G. pose proof (pow_incr (Rabs x) 1 (Datatypes.S (2 * k)))
    as L. rewrite pow1 in L.
  set (u := Rabs x) in *. set (v := (u ^ Datatypes.S (2 * k))%R) in *. clearbody u v. clear X.
  destruct (Rle_or_lt 1 u); [specialize (G ltac:(lra)) | specialize (L ltac:(lra))]; clear K;
  ranges a; unfold has, below, above, none in H, A; cbn in H, A; destruct H as [[H | H] [H' | H']]; try discriminate;
    destruct A as [[A | A] [A' | A']]; try discriminate; try (exfalso; lra); finish.
Qed.

(* x^n for n of either sign; 0 has no negative powers. *)
Theorem power_has a x n : ends a -> has a x -> (n < 0 -> x <> 0%R) -> has (power a n) (powerRZ x n).
Proof.
  intros Ea X N. assert (K : forall k, (0 < k)%nat -> has (if Z.odd (Z.of_nat k) then a else abs a) (x ^ k)).
  { intros k P. destruct (Nat.Even_or_Odd k) as [[m ->] | [m ->]].
    - replace (Z.odd (Z.of_nat (2 * m))) with false by (rewrite Nat2Z.inj_mul, Z.odd_mul; reflexivity). apply
      has_even_power; auto; lia.
    - replace (Z.odd (Z.of_nat (2 * m + 1))) with true by (rewrite Nat2Z.inj_add, Nat2Z.inj_mul, Z.odd_add,
      Z.odd_mul; reflexivity).
      rewrite Nat.add_1_r. now apply has_odd_power. }
  unfold power. destruct n as [| k | k].
  - simpl. unfold has, below, above. cbn. split; right; lra.
  - replace (powerRZ x (Z.pos k)) with (x ^ Pos.to_nat k)%R by reflexivity.
    replace (Z.odd (Z.pos k)) with (Z.odd (Z.of_nat (Pos.to_nat k))) by (now rewrite positive_nat_Z).
    change (Z.pos k =? 0) with false. change (Z.pos k <? 0) with false. cbv iota zeta. apply K. lia.
  - replace (powerRZ x (Z.neg k)) with (1 / x ^ Pos.to_nat k)%R by (simpl; unfold Rdiv; ring).
    replace (Z.odd (Z.neg k)) with (Z.odd (Z.of_nat (Pos.to_nat k))) by (rewrite positive_nat_Z; now destruct k).
    change (Z.neg k =? 0) with false. change (Z.neg k <? 0) with true. cbv iota zeta. apply div_has.
    + apply make_ends.
    + destruct (Z.odd _); [exact Ea | now apply abs_ends].
    + unfold has, below, above. cbn. split; right; lra.
    + apply K. lia.
    + apply pow_nonzero, N. reflexivity.
Qed.

Theorem smaller_larger_has a b x y : has a x -> has b y -> has (smaller a b) (Rmin x y) /\ has (larger a b) (Rmax x
  y).
Proof.
  intros [A A'] [B B']. unfold below, above, none in *. unfold smaller, larger, least, most.
  pose proof (Rmin_l x y). pose proof (Rmin_r x y). pose proof (Rmax_l x y). pose proof (Rmax_r x y).
  split; apply make_has.
  - destruct (Z.ltb_spec (fst a) (fst b)) as [L | L]; [destruct A as [A | A] | destruct B as [B | B]]; try (left;
    lia).
    + destruct B as [B | B]; [left; lia |]. right. apply Z.lt_le_incl, IZR_le in L. apply Rmin_glb; lra.
    + destruct A as [A | A]; [left; lia |]. right. apply IZR_le in L. apply Rmin_glb; lra.
  - destruct (Z.ltb_spec (snd a) (snd b)); [destruct A' as [A' | A'] | destruct B' as [B' | B']]; try (left; lia);
    right; lra.
  - destruct (Z.ltb_spec (fst b) (fst a)); [destruct A as [A | A] | destruct B as [B | B]]; try (left; lia); right;
    lra.
  - destruct (Z.ltb_spec (snd b) (snd a)) as [L | L]; [destruct A' as [A' | A'] | destruct B' as [B' | B']]; try
    (left; lia).
    + destruct B' as [B' | B']; [left; lia |]. right. apply Z.lt_le_incl, IZR_le in L. apply Rmax_lub; lra.
    + destruct A' as [A' | A']; [left; lia |]. right. apply IZR_le in L. apply Rmax_lub; lra.
Qed.

Theorem exp_has a x : ends a -> has a x -> has (of_exp a) (exp x).
Proof.
  intros Ea X. pose proof (exp_pos x). pose proof exp_0.
  assert (U : (0 <= x -> 1 <= exp x)%R) by (intros [L | <-]; [left; rewrite <- exp_0; now apply exp_increasing |
    lra]).
  assert (D : (x <= 0 -> exp x <= 1)%R) by (intros [L | ->]; [left; rewrite <- exp_0; now apply exp_increasing |
    lra]).
  ranges a; known X; try lra; try specialize (U ltac:(lra)); try specialize (D ltac:(lra)); finish.
Qed.

Theorem sine_has x : has (make (-1) 1) (sin x) /\ has (make (-1) 1) (cos x).
Proof. pose proof (SIN_bound x). pose proof (COS_bound x). split; finish. Qed.

Theorem root_has a x : ends a -> has a x -> (0 <= x)%R -> has (of_root a) (sqrt x).
Proof.
  intros Ea X P. pose proof (sqrt_pos x).
  assert (U : (1 <= x -> 1 <= sqrt x)%R) by (intros L; rewrite <- sqrt_1; apply sqrt_le_1; lra).
  assert (D : (x <= 1 -> sqrt x <= 1)%R) by (intros L; rewrite <- sqrt_1; apply sqrt_le_1; lra).
  assert (Z : (x <= 0 -> sqrt x = 0)%R) by (intros L; replace x with 0%R by lra; apply sqrt_0).
  ranges a; known X; try lra; try specialize (U ltac:(lra)); try specialize (D ltac:(lra)); try specialize (Z
    ltac:(lra)); finish.
Qed.

Theorem log_has a x : ends a -> has a x -> (0 < x)%R -> has (of_log a) (ln x).
Proof.
  intros Ea X P. assert (U : (1 <= x -> 0 <= ln x)%R) by (intros [L | <-]; [left; rewrite <- ln_1; apply
    ln_increasing; lra | rewrite ln_1; lra]).
  assert (D : (x <= 1 -> ln x <= 0)%R) by (intros [L | ->]; [left; rewrite <- ln_1; apply ln_increasing; lra |
    rewrite ln_1; lra]).
  ranges a; known X; try lra; try specialize (U ltac:(lra)); try specialize (D ltac:(lra)); finish.
Qed.
