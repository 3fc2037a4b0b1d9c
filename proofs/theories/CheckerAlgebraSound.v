(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What the quotients of CheckerAlgebra.v are: the numbers that the operations are about,
  at leaves where the relations
   hold. *)
From Coq Require Import Reals Lra Lia ZArith NArith List Bool.
From Dyadel Require Import Leaves CheckerEnclosure CheckerEnclosureSound CheckerAlgebra.
Import ListNotations.
Open Scope R_scope.

Section Leaves.

(* The values of leaves. *)
Variable l : nat -> R.

Fixpoint of_monomial (k : nat) (m : monomial) : R :=
  match m with [] => 1 | e :: m' => l k ^ N.to_nat e * of_monomial (S k) m' end.
Definition of_term (t : Z * monomial) : R := IZR (fst t) * of_monomial 0 (snd t).
Fixpoint value_of (p : poly) : R := match p with [] => 0 | t :: q => of_term t + value_of q end.

Lemma compare_equal a : forall b, compare_monomials a b = Eq -> a = b.
Proof.
  induction a as [| d a IH]; intros [| e b]; simpl; try discriminate; trivial.
  destruct (compare_monomials a b) eqn:C; try discriminate. intros E. apply N.compare_eq in E. subst e.
    now rewrite (IH b C).
Qed.

Lemma product_value a : forall k b, of_monomial k (product a b) = of_monomial k a * of_monomial k b.
Proof.
  induction a as [| d a IH]; intros k [| e b]; simpl; try ring. rewrite IH, N2Nat.inj_add, pow_add. ring.
Qed.

Lemma plus_value p : forall q, value_of (plus p q) = value_of p + value_of q.
Proof.
  induction p as [| [c m] p IH]; [intros; simpl; ring |]. intros q. induction q as [| [d n] q IHq]; [simpl; ring |].
  cbn [plus]. destruct (compare_monomials m n) eqn:C.
  - apply compare_equal in C. subst n. destruct (Z.eqb_spec (c + d) 0) as [E | E].
    + rewrite IH. simpl. unfold of_term. simpl.
      replace (IZR c) with (- IZR d) by (rewrite <- opp_IZR; f_equal; lia). ring.
    + simpl. rewrite IH. unfold of_term. simpl. rewrite plus_IZR. ring.
  - cbn [plus] in IHq. cbn [value_of]. rewrite IHq. simpl. ring.
  - cbn [value_of]. rewrite IH. simpl. ring.
Qed.

Lemma scaled_by_value t q : value_of (scaled_by t q) = of_term t * value_of q.
Proof.
  unfold scaled_by. induction q as [| s q IH]; simpl; [ring |]. rewrite IH. unfold of_term. simpl.
  rewrite mult_IZR, product_value. ring.
Qed.

Lemma times_value p q : value_of (times p q) = value_of p * value_of q.
Proof. induction p as [| t p IH]; simpl; [ring |]. rewrite plus_value, scaled_by_value, IH. ring. Qed.

Lemma constant_value z : value_of (constant z) = IZR z.
Proof.
  unfold constant. destruct (Z.eqb_spec z 0) as [-> | _]; simpl; [reflexivity |]. unfold of_term. simpl. ring.
Qed.

Lemma minus_value p : value_of (minus p) = - value_of p.
Proof.
  unfold minus. induction p as [| t p IH]; simpl; [ring |]. rewrite IH. unfold of_term. simpl. rewrite opp_IZR. ring.
Qed.

Lemma variable_value k : value_of (variable k) = l k.
Proof.
  unfold variable. simpl. unfold of_term. simpl.
    assert (G : forall j, of_monomial j (repeat 0%N k ++ [1%N]) = l (j + k)%nat).
  { induction k as [| k IH]; intros j; simpl.
    - rewrite Nat.add_0_r. change (Pos.to_nat 1) with 1%nat. simpl. ring.
    - rewrite IH. replace (S j + k)%nat with (j + S k)%nat by lia. ring. }
  rewrite G. simpl. ring.
Qed.

(* ---- relations ---- *)

Definition relation_holds (k : nat) (r : relation) : Prop := l k ^ N.to_nat (degree r) = value_of (rest r).

Lemma trimmed_value k e m : of_monomial k (trimmed e m) = l k ^ N.to_nat e * of_monomial (S k) m.
Proof. destruct m; simpl; [| reflexivity]. destruct (N.eqb_spec e 0) as [-> |]; simpl; ring. Qed.

Lemma lowered_value d m : forall k j, (d <= exponent k m)%N ->
  of_monomial j m = l (j + k)%nat ^ N.to_nat d * of_monomial j (lowered k d m).
Proof.
  unfold exponent. induction m as [| e m IH]; intros k j H.
  - assert (d = 0%N) by (destruct k; simpl in H; lia). subst d. destruct k; simpl; ring.
  - destruct k as [| k]; cbn [lowered of_monomial]; rewrite trimmed_value.
    + simpl in H. rewrite Nat.add_0_r. replace (N.to_nat e) with (N.to_nat d + N.to_nat (e - d))%nat by lia.
      rewrite pow_add. ring.
    + simpl in H. rewrite (IH k (S j) H). replace (S j + k)%nat with (j + S k)%nat by lia. ring.
Qed.

Lemma partition_value f p : forall a b, partition f p = (a, b) -> value_of p = value_of a + value_of b.
Proof.
  induction p as [| t p IH]; simpl; intros a b E; [injection E as <- <-; simpl; ring |].
  destruct (partition f p) as [c d]. rewrite (IH c d eq_refl). destruct (f t); injection E as <- <-; simpl; ring.
Qed.

Lemma lowered_terms k d p : forallb (fun t => (d <=? exponent k (snd t))%N) p = true ->
  value_of p = l k ^ N.to_nat d * value_of (map (fun t => (fst t, lowered k d (snd t))) p).
Proof.
  induction p as [| t p IH]; simpl; [intros; ring |]. intros E. apply andb_prop in E as [E F]. apply N.leb_le in E.
  rewrite (IH F). unfold of_term. simpl. rewrite (lowered_value d (snd t) k 0 E). simpl. ring.
Qed.

Lemma reduced_by_value n k r : relation_holds k r -> forall p, value_of (reduced_by n k r p) = value_of p.
Proof.
  intros H. induction n as [| n IH]; intros p; [reflexivity |]. cbn [reduced_by]. cbv zeta.
  destruct ((highest k p <? degree r)%N || (degree r =? 0)%N); [reflexivity |].
  destruct (partition _ p) as [a b] eqn:P. apply partition_value in P. destruct (forallb _ a) eqn:A; [| reflexivity].
  rewrite IH, plus_value, times_value, P, (lowered_terms k (degree r) a A), H. ring.
Qed.

Definition relations_hold (k : nat) (rs : list (option relation)) : Prop :=
  forall j r, nth_error rs j = Some (Some r) -> relation_holds (k + j) r.

Lemma reduced_value rs : forall k p, relations_hold k rs -> value_of (reduced k rs p) = value_of p.
Proof.
  induction rs as [| r rs IH]; intros k p H; [reflexivity |]. cbn [reduced]. cbv zeta.
  assert (K : relations_hold (S k) rs).
  { intros j s E. replace (S k + j)%nat with (k + S j)%nat by lia. now apply H. }
  destruct r as [r |]; [| now apply IH]. rewrite reduced_by_value; [now apply IH |].
  specialize (H 0%nat r eq_refl). now rewrite Nat.add_0_r in H.
Qed.

(* ---- quotients ---- *)

Variable most : Z.
Variable rs : list (option relation).
Variable H : relations_hold 0 rs.

Definition is_quotient (q : quotient_of) (x : R) : Prop :=
  match q with Some (a, b) => value_of b <> 0 /\ x = value_of a / value_of b | None => True end.

Lemma divided_value g p : g <> 0%Z -> forallb (fun t => (fst t mod g =? 0)%Z) p = true ->
  value_of p = IZR g * value_of (divided g p).
Proof.
  intros G. unfold divided. induction p as [| t p IH]; simpl; [intros; ring |]. intros E.
    apply andb_prop in E as [E F]. apply Z.eqb_eq in E.
  rewrite (IH F). unfold of_term. simpl.
  replace (IZR (fst t)) with (IZR g * IZR (fst t / g)); [ring |]. rewrite <- mult_IZR. f_equal.
  pose proof (Z.div_mod (fst t) g G). lia.
Qed.

Lemma shortened_is p q x : value_of q <> 0 -> x = value_of p / value_of q -> is_quotient (shortened most p q) x.
Proof.
  intros N E. unfold shortened. destruct (is_small most p && is_small most q); [| exact I]. cbv zeta.
    set (g := content p (content q 0)).
  destruct ((1 <? g)%Z && forallb (fun t => (fst t mod g =? 0)%Z) p && forallb (fun t => (fst t mod g =? 0)%Z) q)
    eqn:B; [| now split].
  apply andb_prop in B as [B Q]. apply andb_prop in B as [G P]. apply Z.ltb_lt in G. assert (G0 : g <> 0%Z) by lia.
  pose proof (divided_value g q G0 Q) as Eq. pose proof (divided_value g p G0 P) as Ep.
  assert (Gr : IZR g <> 0) by (apply not_0_IZR; exact G0). simpl. rewrite Eq in N.
    assert (N' : value_of (divided g q) <> 0).
  { intros Z. apply N. rewrite Z. ring. }
  split; [exact N' |]. rewrite E, Ep, Eq. field. now split.
Qed.

Lemma product_of_value p q : value_of (product_of rs p q) = value_of p * value_of q.
Proof. unfold product_of. now rewrite reduced_value, times_value. Qed.

Lemma q_integer_is n : is_quotient (q_integer n) (IZR n).
Proof. unfold q_integer, is_quotient. rewrite !constant_value. split; [lra | field]. Qed.

Lemma q_fraction_is n d : is_quotient (q_fraction most n d) (IZR n / IZR d).
Proof.
  unfold q_fraction. destruct (Z.eqb_spec d 0) as [D | D]; [exact I |].
  apply shortened_is; rewrite !constant_value; [now apply not_0_IZR | reflexivity].
Qed.

Lemma q_neg_is q x : is_quotient q x -> is_quotient (q_neg q) (- x).
Proof. destruct q as [[a b] |]; simpl; trivial. intros [N ->]. rewrite minus_value.
  split; [exact N | field; exact N]. Qed.

Lemma same_monomial_eq a : forall b, same_monomial a b = true -> a = b.
Proof.
  induction a as [| d a IH]; intros [| e b]; simpl; try discriminate; trivial. intros E.
    apply andb_prop in E as [E F].
  apply N.eqb_eq in E. subst e. now rewrite (IH b F).
Qed.

Lemma same_poly_eq p : forall q, same_poly p q = true -> p = q.
Proof.
  induction p as [| [c m] p IH]; intros [| [d n] q]; simpl; try discriminate; trivial. intros E.
  apply andb_prop in E as [E F]. apply andb_prop in E as [E G]. apply Z.eqb_eq in E. apply same_monomial_eq in G.
    subst d n.
  now rewrite (IH q F).
Qed.

Lemma q_add_is q r x y : is_quotient q x -> is_quotient r y -> is_quotient (q_add most rs q r) (x + y).
Proof.
  destruct q as [[a b] |], r as [[c d] |]; try (intros; exact I). intros [B ->] [D ->]. unfold q_add.
    destruct (same_poly b d) eqn:E.
  - apply same_poly_eq in E. subst d. apply shortened_is; [exact B |]. rewrite plus_value. field. exact B.
  - destruct (is_light a d && is_light b c && is_light b d); [| exact I].
    apply shortened_is; rewrite ?plus_value, !product_of_value;
      [now apply Rmult_integral_contrapositive_currified |]. field. now split.
Qed.

Lemma q_sub_is q r x y : is_quotient q x -> is_quotient r y -> is_quotient (q_sub most rs q r) (x - y).
Proof. intros. unfold q_sub, Rminus. now apply q_add_is, q_neg_is. Qed.

Lemma q_mul_is q r x y : is_quotient q x -> is_quotient r y -> is_quotient (q_mul most rs q r) (x * y).
Proof.
  destruct q as [[a b] |], r as [[c d] |]; try (intros; exact I). intros [B ->] [D ->]. unfold q_mul.
  destruct (is_light a c && is_light b d); [| exact I].
  apply shortened_is; rewrite !product_of_value; [now apply Rmult_integral_contrapositive_currified |]. field.
    now split.
Qed.

Lemma q_inverse_is q x : x <> 0 -> is_quotient q x -> is_quotient (q_inverse q) (/ x).
Proof.
  destruct q as [[a b] |]; simpl; trivial. intros N [B ->]. assert (A : value_of a <> 0).
  { intros Z. apply N. rewrite Z. field. exact B. }
  split; [exact A |]. field. now split.
Qed.

Lemma q_power_is q x n : is_quotient q x -> is_quotient (q_power most rs q n) (x ^ Pos.to_nat n).
Proof.
  intros Q. induction n as [n IH | n IH |]; cbn [q_power].
  - rewrite Pos2Nat.inj_xI. simpl. rewrite Nat.add_0_r, pow_add. now apply q_mul_is, q_mul_is.
  - rewrite Pos2Nat.inj_xO. simpl. rewrite Nat.add_0_r, pow_add. now apply q_mul_is.
  - simpl. now rewrite Rmult_1_r.
Qed.

Lemma q_power_Z_is q x n : x <> 0 \/ (0 <= n)%Z -> is_quotient q x ->
  is_quotient (q_power_Z most rs q n) (powerRZ x n).
Proof.
  intros N Q. destruct n as [| n | n]; simpl powerRZ; cbn [q_power_Z];
    [apply (q_integer_is 1) | now apply q_power_is |].
  destruct N as [N | N]; [| lia]. rewrite <- pow_inv. now apply q_power_is, q_inverse_is.
Qed.

Lemma null_is_zero q x : is_quotient q x -> is_null q = true -> x = 0.
Proof. destruct q as [[[| t a] b] |]; try discriminate. simpl. intros [N ->] _. field. exact N. Qed.

Lemma equal_are q r x y : is_quotient q x -> is_quotient r y -> are_equal most rs q r = true -> x = y.
Proof. intros Q S E. apply Rminus_diag_uniq. apply (null_is_zero _ _ (q_sub_is q r x y Q S) E). Qed.

Lemma q_horner_is f q x : is_quotient q x -> is_quotient (q_horner most rs f q) (at_ f x).
Proof.
  intros Q. induction f as [| c f IH]; cbn [q_horner at_]; [apply (q_integer_is 0) |].
  apply q_add_is; [apply q_integer_is | now apply q_mul_is].
Qed.

(* ---- enclosures ---- *)

Variable u : Z.
Variable U : (0 < u)%Z.

Definition leaves_held (k : nat) (held : list interval) : Prop := forall j e,
  nth_error held j = Some e -> holds u e (l (k + j)).

Lemma enclose_monomial_holds m : forall k held,
  leaves_held k held -> holds u (enclose_monomial most u m held) (of_monomial k m).
Proof.
  induction m as [| e m IH]; intros k held L; cbn [enclose_monomial of_monomial]; [now apply (whole_holds u 1) |].
  destruct held as [| x held]; [exact I |]. cbv zeta. assert (K : leaves_held (S k) held).
  { intros j f E. replace (S k + j)%nat with (k + S j)%nat by lia. now apply L. }
  pose proof (L 0%nat x eq_refl) as X. rewrite Nat.add_0_r in X. specialize (IH (S k) held K).
  destruct e as [| n]; cbn [N.to_nat]; [simpl; now rewrite Rmult_1_l |]. apply mul_holds; trivial.
    now apply power_holds.
Qed.

Lemma enclose_poly_holds p held : leaves_held 0 held -> holds u (enclose_poly most u held p) (value_of p).
Proof.
  intros L. induction p as [| t p IH]; [now apply (whole_holds u 0) |].
    change (holds u (add (mul most u (whole u (fst t)) (enclose_monomial most u (snd t) held)) (enclose_poly most u
    held p)) (of_term t + value_of p)).
  apply add_holds; trivial. unfold of_term.
    apply mul_holds; trivial; [now apply whole_holds | now apply enclose_monomial_holds].
Qed.

End Leaves.
