(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What the lines of a block mean, and that of a block which the checker takes every number is defined,
  is in its interval,
   and is its quotient. *)
From Coq Require Import Reals Lra Lia ZArith NArith List Bool.
From Dyadel Require Import Leaves Checker CheckerEnclosure CheckerEnclosureSound CheckerInverse CheckerInverseSound
  CheckerAlgebra CheckerAlgebraSound CheckerBlock.
Import ListNotations.
Open Scope R_scope.
Local Opaque mul whole cosine sine exponential square_root cube_root inverse_value.

Section Meaning.

(* The numbers, the leaves. *)
Variable v : Z -> R.
Variable l : nat -> R.

(* Line k says that number k is this. A callback may be any number. *)
Definition described (k : Z) (o : line) : Prop :=
  match o with
  | Value p q => v k = value_of l p / value_of l q
  | Plus a b => v k = v a + v b
  | Minus a b => v k = v a - v b
  | Times a b => v k = v a * v b
  | Divided a b => v k = v a / v b
  | Least a b => v k = Rmin (v a) (v b)
  | Greatest a b => v k = Rmax (v a) (v b)
  | Power a n => v k = powerRZ (v a) n
  | Opposite a => v k = - v a
  | Claim a => v k = v a
  | Absolute a => v k = Rabs (v a)
  | SquareRoot a _ => v k = sqrt (v a)
  | CubeRoot a _ => v k * v k * v k = v a
  | Cosine a => v k = cos (v a)
  | Sine a => v k = sin (v a)
  | Tangent a => v k = tan (v a)
  | Exponential a => v k = exp (v a)
  | HyperbolicSine a => v k = sinh (v a)
  | HyperbolicCosine a => v k = cosh (v a)
  | HyperbolicTangent a => v k = tanh (v a)
  | Inverse f a => v k = inverse_at f (v a)
  | Pi => v k = PI
  | Euler => v k = exp 1
  | Cycle n => v k = Leaves.turn (Z.to_nat n)
  | Root r _ => root_of r (v k)
  | Callback => True
  end.

Definition is_stated (s : stated) (x : R) : Prop :=
  match s with Some (p, q) => value_of l q <> 0 /\ x = value_of l p / value_of l q | None => True end.

(* The operation is defined there; a root is the only one between the ends; the statements on the number are true. *)
Definition defined (k : Z) (o : line) : Prop :=
  match o with
  | Value p q => value_of l q <> 0
  | Divided a b => v b <> 0
  | Power a n => (n < 0)%Z -> v a <> 0
  | SquareRoot a s => 0 <= v a /\ is_stated s (v k)
  | CubeRoot _ s => is_stated s (v k)
  | Tangent a => cos (v a) <> 0
  | Inverse f a => inverse_defined f (v a)
  | Cycle n => (0 < n)%Z
  | Root r s => (forall x, root_of r x -> x = v k) /\ is_stated s (v k)
  | _ => True
  end.

Definition kind_value (f : kind) : R :=
  match f with
  | Multiple c a => IZR c * v a
  | CosineOf a => cos (v a)
  | SineOf a => sin (v a)
  | ExpOf a => exp (v a)
  | ExpOne => exp 1
  | HalfTurn => PI
  | PartOfTurn n => Leaves.turn (Z.to_nat n)
  | InverseOf f a => inverse_at f (v a)
  end.

(* The leaves are what the list says. *)
Definition agrees (ls : list leaf) : Prop := forall j f, nth_error ls j = Some f -> l j = kind_value (leaf_kind f).

Section Sound.

Variable most : Z.
Variable root_hint : Z -> Z -> Z.
Variable zero_hint : Z -> bracket -> Z.
Variable u : Z.
Variable U : (0 < u)%Z.
Variable turn : interval.
Variable T : holds u turn PI.

Definition known_ok (x : known) (r : R) : Prop := holds u (within x) r /\ is_quotient l (is x) r.
Definition leaf_ok (j : nat) (f : leaf) : Prop :=
  holds u (leaf_at f) (l j) /\ forall r, leaf_relation f = Some r -> relation_holds l j r.
Definition leaves_ok (i : nat) (ls : list leaf) : Prop := forall j f, nth_error ls j = Some f -> leaf_ok (i + j) f.
Definition state_ok (st : state) : Prop :=
  (forall a x, Map.find a (numbers st) = Some x -> known_ok x (v a)) /\ leaves_ok 0 (leaves st).

Section Step.

Variable st : state.
Variable St : state_ok st.
Variable k : Z.

Lemma relations_there : relations_hold l 0 (relations st).
Proof.
  intros j r E. unfold relations in E. rewrite nth_error_map in E.
    destruct (nth_error (leaves st) j) as [f |] eqn:F; [| discriminate].
  injection E as E. exact (proj2 (proj2 St j f F) r E).
Qed.

Lemma leaves_there : leaves_held l u 0 (held st).
Proof.
  intros j e E. unfold held in E. rewrite nth_error_map in E.
    destruct (nth_error (leaves st) j) as [f |] eqn:F; [| discriminate].
  injection E as <-. exact (proj1 (proj2 St j f F)).
Qed.

Let R0 := relations_there.

Lemma leaf_q_is j : is_quotient l (leaf_q j) (l j).
Proof. unfold leaf_q, is_quotient. rewrite variable_value, constant_value. split; [lra | field]. Qed.

Local Opaque leaf_q q_neg q_inverse plus minus times variable constant.

Lemma leaf_of_new more f j : agrees (leaves st ++ more) -> nth_error more j = Some f ->
  l (fresh st + j)%nat = kind_value (leaf_kind f).
Proof. intros A E. apply A. unfold fresh. rewrite nth_error_app2 by lia.
  replace (length (leaves st) + j - length (leaves st))%nat with j by lia. exact E. Qed.

Lemma agrees_before more : agrees (leaves st ++ more) -> agrees (leaves st).
Proof. intros A j f E. apply A. rewrite nth_error_app1; [exact E |]. apply nth_error_Some. congruence. Qed.

Lemma none_new : leaves_ok (fresh st) [].
Proof. intros [| j] f E; discriminate. Qed.

Lemma enclose_holds p : holds u (enclose_poly most u (held st) p) (value_of l p).
Proof. apply enclose_poly_holds; [exact U | exact leaves_there]. Qed.

Lemma value_known_ok p q x : value_known most u st p q = Some x ->
  value_of l q <> 0 /\ known_ok x (value_of l p / value_of l q).
Proof.
  unfold value_known. destruct (is_before st p && is_before st q && negb (sign_of (enclose_poly most u (held st) q)
    =? 0)%Z) eqn:E;
    [| discriminate]. intros X. injection X as <-. apply andb_prop in E as [_ E]. apply negb_true_iff, Z.eqb_neq in E.
  assert (N : value_of l q <> 0) by (apply (sign_not_zero u U _ _ (enclose_holds q) E)). split; [exact N |].
    split; cbn [within is].
  - unfold enclose. now apply quotient_holds; [exact U | apply enclose_holds ..].
  - apply shortened_is; rewrite !reduced_value by exact R0; trivial.
Qed.

Lemma known_at_ok a x : known_at st a = Some x -> known_ok x (v a).
Proof. apply St. Qed.

Lemma sum_ok x y r s : known_ok x r -> known_ok y s -> known_ok (sum_of most st x y) (r + s).
Proof. intros [] []. split; [now apply add_holds | now apply q_add_is]. Qed.
Lemma difference_ok x y r s : known_ok x r -> known_ok y s -> known_ok (difference_of most st x y) (r - s).
Proof. intros [] []. split; [now apply sub_holds | now apply q_sub_is]. Qed.
Lemma product_ok x y r s : known_ok x r -> known_ok y s -> known_ok (product_known most u st x y) (r * s).
Proof. intros [] []. split; [now apply mul_holds | now apply q_mul_is]. Qed.

Lemma inverse_ok x y r : known_ok x r -> inverse_of u x = Some y -> r <> 0 /\ known_ok y (/ r).
Proof.
  intros [H Q]. unfold inverse_of. destruct (Z.eqb_spec (sign_of (within x)) 0) as [E | E]; [discriminate |].
    intros X. injection X as <-.
  assert (N : r <> 0) by exact (sign_not_zero u U _ _ H E). split; [exact N |].
    split; [now apply inverse_holds | now apply q_inverse_is].
Qed.

Lemma ratio_ok x y z r s : known_ok x r -> known_ok y s -> ratio_of most u st x y = Some z ->
  s <> 0 /\ known_ok z (r / s).
Proof.
  intros X Y. unfold ratio_of. destruct (inverse_of u y) as [w |] eqn:E; [| discriminate]. intros Z.
    injection Z as <-.
  destruct (inverse_ok y w s Y E) as [N W]. split; [exact N |]. now apply product_ok.
Qed.

Lemma extreme_least x y r s : known_ok x r -> known_ok y s -> is_quotient l (extreme_is most st (-1) x y) (Rmin r s).
Proof.
  intros [X Q] [Y P]. unfold extreme_is. destruct (are_equal most (relations st) (is x) (is y)) eqn:E.
  - apply (equal_are l most _ R0 _ _ r s) in E; trivial. subst s. rewrite Rmin_left by lra. exact Q.
  - pose proof (sub_holds u _ _ _ _ X Y) as D.
    destruct (Z.eqb_spec (sign_of (sub (within x) (within y))) (-1)) as [S | S].
    + apply (sign_negative u U _ _ D) in S. rewrite Rmin_left by lra. exact Q.
    + destruct (Z.eqb_spec (sign_of (sub (within x) (within y))) (- -1)) as [S' | S']; [| exact I].
      apply (sign_positive u U _ _ D) in S'. rewrite Rmin_right by lra. exact P.
Qed.

Lemma extreme_greatest x y r s : known_ok x r -> known_ok y s -> is_quotient l (extreme_is most st 1 x y) (Rmax r s).
Proof.
  intros [X Q] [Y P]. unfold extreme_is. destruct (are_equal most (relations st) (is x) (is y)) eqn:E.
  - apply (equal_are l most _ R0 _ _ r s) in E; trivial. subst s. rewrite Rmax_left by lra. exact Q.
  - pose proof (sub_holds u _ _ _ _ X Y) as D.
    destruct (Z.eqb_spec (sign_of (sub (within x) (within y))) 1) as [S | S].
    + apply (sign_positive u U _ _ D) in S. rewrite Rmax_left by lra. exact Q.
    + destruct (Z.eqb_spec (sign_of (sub (within x) (within y))) (- (1))) as [S' | S']; [| exact I].
      apply (sign_negative u U _ _ D) in S'. rewrite Rmax_right by lra. exact P.
Qed.

Lemma absolute_ok x r : known_ok x r -> is_quotient l (absolute_is x) (Rabs r).
Proof.
  intros [X Q]. unfold absolute_is. destruct (is_null (is x)) eqn:N; simpl.
  - apply (null_is_zero l _ _ Q) in N as Z. subst r. rewrite Rabs_R0. exact Q.
  - destruct (Z.eqb_spec (sign_of (within x)) 1) as [S | S].
    + apply (sign_positive u U _ _ X) in S. rewrite Rabs_pos_eq by lra. exact Q.
    + destruct (Z.eqb_spec (sign_of (within x)) (-1)) as [S' | S']; [| exact I].
      apply (sign_negative u U _ _ X) in S'.
      rewrite Rabs_left1 by lra. now apply q_neg_is.
Qed.

Lemma integer_value p c : integer_of p = Some c -> value_of l p = IZR c.
Proof.
  unfold integer_of. destruct p as [| [d [| e m]] [| t p]]; try discriminate. intros E. injection E as ->.
  simpl. unfold of_term. simpl. ring.
Qed.

(* x is a new leaf over c. *)
Lemma new_root_ok c n r e y more x : c <> 0%Z -> v k = x -> holds u e x -> new_root most u st k c n r e = (y, more) ->
  agrees (leaves st ++ more) -> (IZR c * x) ^ N.to_nat n = value_of l r -> known_ok y x /\ leaves_ok (fresh st) more.
Proof.
  intros C V E X A P. apply pair_equal_spec in X as [<- <-].
  pose proof (leaf_of_new _ _ 0 A eq_refl) as L. rewrite Nat.add_0_r in L. cbn [leaf_kind kind_value] in L.
    rewrite V in L.
  assert (C' : IZR c <> 0) by now apply not_0_IZR. split; [split; cbn [within is] |].
  - exact E.
  - unfold is_quotient. rewrite variable_value, constant_value, L. split; [exact C' | field; exact C'].
  - intros [| [| j]] f F; try discriminate. injection F as <-. rewrite Nat.add_0_r.
    split; cbn [leaf_at leaf_relation].
    + rewrite L. apply mul_holds; trivial. now apply whole_holds.
    + intros r' E'. injection E' as <-. unfold relation_holds. cbn [degree rest]. now rewrite L.
Qed.

Lemma some_pair {A B : Type} (a c : A) (b d : B) : Some (a, b) = Some (c, d) -> c = a /\ d = b.
Proof. intros E. now injection E. Qed.

Lemma cubes_equal x y : x * x * x = y * y * y -> x = y.
Proof. intros E. apply Rle_antisym; apply cube_monotone; lra. Qed.

Lemma radical_ok (cubic : bool) x r s y more : known_ok x r ->
  radical_of most root_hint u st k cubic x s = Some (y, more) ->
  (if cubic then v k * v k * v k = r else v k = sqrt r) -> agrees (leaves st ++ more) ->
  (cubic = false -> 0 <= r) /\ is_stated s (v k) /\ known_ok y (v k) /\ leaves_ok (fresh st) more.
Proof.
  intros [X Q] E V A. unfold radical_of in E. cbv zeta in E.
  set (e := if cubic then cube_root root_hint u (within x) else square_root root_hint u (within x)) in *.
  assert (H : (cubic = false -> 0 <= r) -> holds u e (v k)).
  { intros P. unfold e. destruct cubic; [now apply (cube_root_holds root_hint u U _ r) |].
    rewrite V. apply square_root_holds; auto. }
  destruct s as [[p q] |].
  - destruct (value_known most u st p q) as [w |] eqn:W; [| discriminate]. apply value_known_ok in W as [N [W P]].
    set (z := value_of l p / value_of l q) in *.
    match type of E with (if ?b then _ else _) = _ => destruct b eqn:B; [| discriminate] end.
    apply some_pair in E as [-> ->]. apply andb_prop in B as [B S].
    assert (Z : (cubic = false -> 0 <= r) /\ v k = z).
    { pose proof (q_mul_is l most _ R0 _ _ z z P P) as P2. destruct cubic.
      - apply (equal_are l most _ R0 _ _ (z * (z * z)) r) in B; trivial; [| now apply q_mul_is].
        split; [discriminate |]. apply cubes_equal. rewrite V, <- B. ring.
      - apply (equal_are l most _ R0 _ _ (z * z) r) in B; trivial. cbn [orb] in S.
        assert (Z0 : 0 <= z).
        { apply orb_prop in S as [S | S]; [rewrite (null_is_zero l _ _ P S); lra |]. apply Z.eqb_eq in S.
          pose proof (sign_positive u U _ _ W S). lra. }
        split; [intros _; rewrite <- B; nra |]. rewrite V, <- B. now apply sqrt_square. }
    destruct Z as [Zr Zv]. split; [exact Zr |]. split; [now split |]. split; [| apply none_new].
    split; cbn [within is]; [now apply H | now rewrite Zv].
  - destruct (is_null (is x)) eqn:N.
    + apply some_pair in E as [-> ->]. apply (null_is_zero l _ _ Q) in N. subst r.
      assert (V0 : v k = 0) by (destruct cubic; [apply cubes_equal; rewrite V; ring | rewrite V; apply sqrt_0]).
      rewrite V0. split; [intros _; lra |]. split; [exact I |]. split; [now split | apply none_new].
    + destruct (is x) as [[p q] |] eqn:X0; [| discriminate]. destruct (integer_of q) as [c |] eqn:C; [| discriminate].
      destruct (negb (c =? 0)%Z && (cubic || (sign_of (within x) =? 1)%Z)) eqn:B; [| discriminate].
      apply andb_prop in B as [B S]. apply negb_true_iff, Z.eqb_neq in B. apply integer_value in C.
      destruct Q as [Nq Eq]. rewrite C in Eq, Nq.
      assert (P : cubic = false -> 0 <= r).
      { intros ->. cbn [orb] in S. apply Z.eqb_eq in S. pose proof (sign_positive u U _ _ X S). lra. }
      assert (Lp : value_of l p = r * IZR c) by (rewrite Eq; field; exact Nq). injection E as E.
      split; [exact P |]. split; [exact I |].
      destruct cubic; (eapply new_root_ok; [exact B | reflexivity | now apply H | exact E | exact A |]);
        rewrite times_value, constant_value, Lp.
      * rewrite mult_IZR, <- V. change (N.to_nat 3) with 3%nat. simpl. ring.
      * change (N.to_nat 2) with 2%nat. rewrite V. simpl. transitivity (IZR c * IZR c * (sqrt r * sqrt r)); [ring |].
        rewrite sqrt_sqrt by auto. ring.
Qed.

Lemma in_leaf_value j f : value_of l (in_leaf j f) = Leaves.at_ f (l j).
Proof.
  induction f as [| c f IH]; cbn [in_leaf Leaves.at_]; [reflexivity |].
    rewrite plus_value, times_value, constant_value, variable_value, IH. ring.
Qed.

Lemma monic_rest_powers a f : monic_rest a f = (powers a f, (a ^ Z.of_nat (length f))%Z).
Proof.
  induction f as [| c f IH]; [reflexivity |]. cbn [monic_rest powers length]. rewrite IH.
    rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia. now rewrite Z.mul_comm with (m := a).
Qed.

Lemma polynomial_root_ok r s y more : polynomial_root most zero_hint u st k r s = Some (y, more) -> root_of r (v k) ->
  agrees (leaves st ++ more) ->
  (forall x, root_of r x -> x = v k) /\ is_stated s (v k) /\ known_ok y (v k) /\ leaves_ok (fresh st) more.
Proof.
  intros E V A. unfold polynomial_root in E. cbv zeta in E. destruct (is_single most u r) eqn:Si; [| discriminate].
    cbn [negb] in E.
  pose proof (enclose_root_holds most u r (zero_hint u r) (v k) U Si V) as H.
  split; [intros x X; now apply (CheckerEnclosureSound.root_unique most u r) |]. destruct s as [[p q] |].
  - destruct (value_known most u st p q) as [w |] eqn:W; [| discriminate]. apply value_known_ok in W as [N [W P]].
    set (z := value_of l p / value_of l q) in *.
    destruct (is_null (q_horner most (relations st) (coefficients r) (is w)) && (sign_of (sub (within w) (fraction u
      (lo_num r) (lo_den r))) =? 1)%Z
      && (sign_of (sub (fraction u (hi_num r) (hi_den r)) (within w)) =? 1)%Z) eqn:B; [| discriminate].
    injection E as <- <-. apply andb_prop in B as [B Hi]. apply andb_prop in B as [B Lo]. apply Z.eqb_eq in Hi, Lo.
    destruct (single_parts most u r U Si) as (Dl & Dh & _).
    pose proof (sign_positive u U _ _ (sub_holds u _ _ _ _ W (fraction_holds u _ _ Dl)) Lo).
    pose proof (sign_positive u U _ _ (sub_holds u _ _ _ _ (fraction_holds u _ _ Dh) W) Hi).
    assert (Z : root_of r z).
    { split; [unfold lo_end, hi_end; lra |]. apply (null_is_zero l _ _ (q_horner_is l most _ R0 (coefficients r) (is
      w) z P) B). }
    assert (Vz : v k = z) by now apply (CheckerEnclosureSound.root_unique most u r).
    split; [now split; [| rewrite Vz] |]. split; [| apply none_new].
      split; cbn [within is]; [exact H | now rewrite Vz].
  - destruct (rev (coefficients r)) as [| a f] eqn:C; [discriminate |].
    destruct (Z.eqb_spec a 0) as [Z | Z]; [discriminate |].
    split; [exact I |]. assert (Cf : coefficients r = rev f ++ [a]) by (rewrite <- (rev_involutive (coefficients
      r)), C; reflexivity).
    apply (new_root_ok a (N.of_nat (length f)) (minus (in_leaf (fresh st) (fst (monic_rest a (rev f)))))
      (enclose_root u r (zero_hint u r))); trivial; [congruence |].
    rewrite minus_value, in_leaf_value, monic_rest_powers, Nat2N.id. cbn [fst].
    assert (L : l (fresh st) = IZR a * v k).
    { unfold new_root in E. injection E as _ <-. pose proof (leaf_of_new _ _ 0 A eq_refl) as L.
      rewrite Nat.add_0_r in L. exact L. }
    rewrite L. destruct V as [_ F]. rewrite Cf in F. destruct (rev f) as [| b g] eqn:Rf.
    + assert (f = []) by (rewrite <- (rev_involutive f), Rf; reflexivity). subst f. simpl in F.
      apply not_0_IZR in Z. exfalso. apply Z. lra.
    + assert (M : Leaves.at_ (monic (b :: g) a) (IZR a * v k) = 0) by (apply monic_root; trivial; discriminate).
      unfold monic in M. rewrite at_app, powers_length in M.
        replace (length f) with (length (b :: g)) by (rewrite <- Rf; apply rev_length).
      simpl (Leaves.at_ [1%Z] _) in M. lra.
Qed.

(* ---- leaves that are found ---- *)

Lemma find_leaf_found helps key x ls : forall j i same, find_leaf most st helps key x j ls = Some (i, same) ->
  exists f y, (j <= i)%nat /\ nth_error ls (i - j) = Some f /\ key (leaf_kind f) = Some y /\
    are_equal most (relations st) y (if same then x else q_neg x) = true /\ (same = true \/ helps = true).
Proof.
  induction ls as [| f ls IH]; intros j i same E; [discriminate |]. cbn [find_leaf] in E.
  assert (Later : find_leaf most st helps key x (S j) ls = Some (i, same) -> exists f0 y,
    (j <= i)%nat /\ nth_error (f :: ls) (i - j) = Some f0 /\
    key (leaf_kind f0) = Some y /\ are_equal most (relations st) y (if same then x else q_neg x) = true /\
    (same = true \/ helps = true)).
  { intros F. destruct (IH _ _ _ F) as (g & y & L & N & K & Q & B). exists g, y.
    replace (i - j)%nat with (S (i - S j)) by lia. repeat split; trivial. lia. }
  destruct (key (leaf_kind f)) as [y |] eqn:K; [| now apply Later].
  destruct (are_equal most (relations st) y x) eqn:Q; [injection E as <- <-; exists f, y; rewrite Nat.sub_diag;
    repeat split; trivial; now left |].
  destruct (helps && are_equal most (relations st) y (q_neg x)) eqn:P; [| now apply Later].
  apply andb_prop in P as [H P]. injection E as <- <-. exists f, y. rewrite Nat.sub_diag.
  repeat split; trivial. now right.
Qed.

Lemma key_sign y x r s (same : bool) : is_quotient l x r -> is_quotient l y s ->
  are_equal most (relations st) y (if same then x else q_neg x) = true -> s = if same then r else - r.
Proof.
  intros Q P E. destruct same.
  - exact (equal_are l most _ R0 _ _ s r P Q E).
  - exact (equal_are l most _ R0 _ _ s (- r) P (q_neg_is l _ _ Q) E).
Qed.

Lemma quotient_at_is a q : quotient_at st a = Some q -> is_quotient l q (v a).
Proof.
  unfold quotient_at. destruct (Map.find a (numbers st)) as [x |] eqn:F; [| discriminate]. intros E.
    injection E as <-.
  exact (proj2 (proj1 St a x F)).
Qed.

Lemma pi2_holds : holds u (pi2 turn) (PI / 2).
Proof. unfold pi2. now apply (over_holds u 2). Qed.

(* ---- parts of the turn ---- *)

Lemma only_leaf_value m : forall i j, only_leaf i m = Some j -> of_monomial l i m = l j.
Proof.
  induction m as [| e m IH]; intros i j E; [discriminate |]. cbn [only_leaf of_monomial] in *. destruct m as [| f m].
  - destruct (N.eqb_spec e 1) as [-> | N]; [| discriminate]. injection E as <-. simpl. ring.
  - destruct (N.eqb_spec e 0) as [-> | N]; [| discriminate]. rewrite (IH _ _ E). simpl. ring.
Qed.

Lemma part_of_turn_ok x r n d : agrees (leaves st) -> is_quotient l x r -> part_of_turn st x = Some (n, d) ->
  d <> 0%Z /\ r = 2 * PI * (IZR n / IZR d).
Proof.
  intros A Q E. unfold part_of_turn in E. destruct x as [[[| [c m] p] q] |]; [| | discriminate].
  - injection E as <- <-. destruct Q as [_ Q]. rewrite Q. simpl. split; [lia |]. unfold Rdiv. ring.
  - destruct p as [| t p]; [| discriminate]. destruct (integer_of q) as [z |] eqn:Z0; [| discriminate].
    destruct (only_leaf 0 m) as [j |] eqn:O; [| discriminate].
    destruct (nth_error (leaves st) j) as [f |] eqn:N; [| discriminate].
    destruct (is_half_turn f) eqn:H; [| discriminate]. assert (n = c) by congruence. assert (d = 2 * z)%Z by congruence.
    subst n d. destruct Q as [Nq Q].
    apply integer_value in Z0. rewrite Z0 in Nq, Q. pose proof (A j f N) as L. unfold is_half_turn in H.
    destruct (leaf_kind f); try discriminate. cbn [kind_value] in L.
    assert (z <> 0%Z) by (intros ->; now apply Nq). split; [lia |].
    rewrite Q, mult_IZR. cbn [value_of]. unfold of_term. cbn [fst snd].
    rewrite (only_leaf_value _ _ _ O), L. field. exact Nq.
Qed.

Lemma find_part_found ls : forall j i n, find_part j ls = Some (i, n) ->
  exists f, (j <= i)%nat /\ nth_error ls (i - j) = Some f /\ leaf_kind f = PartOfTurn n.
Proof.
  induction ls as [| f ls IH]; intros j i n E; [discriminate |]. cbn [find_part] in E.
  assert (Later : find_part (S j) ls = Some (i, n) ->
    exists g, (j <= i)%nat /\ nth_error (f :: ls) (i - j) = Some g /\ leaf_kind g = PartOfTurn n).
  { intros F. destruct (IH _ _ _ F) as (g & L & N & K). exists g. replace (i - j)%nat with (S (i - S j)) by lia.
    repeat split; trivial. lia. }
  destruct (leaf_kind f) eqn:K; try now apply Later.
  injection E as <- <-. exists f. rewrite Nat.sub_diag. now repeat split.
Qed.

Lemma cos_turns z x : cos (x + 2 * PI * IZR z) = cos x.
Proof.
  destruct (Z.le_ge_cases 0 z) as [P | P].
  - rewrite <- (Z2Nat.id z P), <- INR_IZR_INZ. rewrite <- (cos_period x (Z.to_nat z)). f_equal. ring.
  - rewrite <- (cos_period (x + 2 * PI * IZR z) (Z.to_nat (- z))). f_equal.
    rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR by lia. ring.
Qed.

(* Of all multiples only those up to half the turn are needed. *)
Lemma cosine_folded z order : (0 < order)%Z ->
  cos (2 * PI * (IZR z / IZR order)) =
  cos (INR (Z.to_nat (Z.min (z mod order) (order - z mod order))) * (2 * PI / INR (Z.to_nat order))).
Proof.
  intros P. pose proof (Z.mod_pos_bound z order P) as B. pose proof (IZR_lt _ _ P) as P'.
  rewrite !INR_IZR_INZ, !Z2Nat.id by lia.
  assert (E : cos (2 * PI * (IZR z / IZR order)) = cos (2 * PI * (IZR (z mod order) / IZR order))).
  { rewrite <- (cos_turns (z / order) (2 * PI * (IZR (z mod order) / IZR order))). f_equal.
    rewrite (Z.div_mod z order) at 1 by lia. rewrite plus_IZR, mult_IZR. field. lra. }
  rewrite E. destruct (Z.le_ge_cases (z mod order) (order - z mod order)) as [L | L].
  - rewrite Z.min_l by exact L. f_equal. field. lra.
  - rewrite Z.min_r by exact L. rewrite minus_IZR, <- cos_neg, <- (cos_turns 1). f_equal. field. lra.
Qed.

Lemma part_cosine_ok n d : agrees (leaves st) ->
  is_quotient l (part_cosine most st n d) (cos (2 * PI * (IZR n / IZR d))).
Proof.
  intros A. unfold part_cosine. destruct (find_part 0 (leaves st)) as [[j order] |] eqn:F.
  - destruct ((0 <? order)%Z && negb (d =? 0)%Z && (order * n mod d =? 0)%Z) eqn:B; [| exact I].
    apply andb_prop in B as [B M]. apply andb_prop in B as [P D]. apply Z.ltb_lt in P. apply Z.eqb_eq in M.
    apply negb_true_iff, Z.eqb_neq in D. destruct (find_part_found _ _ _ _ F) as (f & _ & N & K).
    rewrite Nat.sub_0_r in N. pose proof (A j f N) as L. rewrite K in L. cbn [kind_value] in L.
    cbv zeta. pose proof (Z.div_exact (order * n) d D) as [_ X]. specialize (X M).
    set (z := (order * n / d)%Z) in *.
    assert (E : IZR n / IZR d = IZR z / IZR order).
    { apply (f_equal IZR) in X. rewrite !mult_IZR in X. apply not_0_IZR in D. pose proof (IZR_lt _ _ P).
      apply Rmult_eq_reg_r with (IZR d * IZR order); [| now apply Rmult_integral_contrapositive; split; lra].
      transitivity (IZR order * IZR n); [field; lra |]. rewrite X. field. lra. }
    rewrite E, (cosine_folded z order P).
    apply shortened_is; rewrite constant_value; [lra |]. rewrite reduced_value by exact R0.
    rewrite in_leaf_value, L. unfold Leaves.turn. rewrite chebyshev_cosine. field.
  - destruct ((0 <? 1)%Z && negb (d =? 0)%Z && (1 * n mod d =? 0)%Z) eqn:B; [| exact I].
    apply andb_prop in B as [B M]. apply andb_prop in B as [_ D]. apply Z.eqb_eq in M.
    apply negb_true_iff, Z.eqb_neq in D. pose proof (Z.div_exact (1 * n) d D) as [_ X]. specialize (X M).
    rewrite Z.mul_1_l in X. set (z := (n / d)%Z) in *. apply (f_equal IZR) in X. rewrite mult_IZR in X.
    apply not_0_IZR in D. replace (2 * PI * (IZR n / IZR d)) with (0 + 2 * PI * IZR z) by (rewrite X; field; exact D).
    rewrite cos_turns, cos_0. apply (q_integer_is l 1).
Qed.

Lemma part_relation_ok n r : part_relation st n = Some r -> (0 < n)%Z /\
  (l (fresh st) = Leaves.turn (Z.to_nat n) -> relation_holds l (fresh st) r).
Proof.
  unfold part_relation. intros E.
  destruct ((0 <? n)%Z && (n <=? most_order)%Z && CheckerCycle.cycle_is_psi (Z.to_nat n)) eqn:B; [| discriminate].
  apply andb_prop in B as [B C]. apply andb_prop in B as [P _]. apply Z.ltb_lt in P. split; [exact P |]. intros L.
  apply cycle_zero in C. rewrite <- L in C.
  destruct (rev (CheckerCycle.psi (Z.to_nat n))) as [| [| [] |] f] eqn:Rf; try discriminate. injection E as <-.
  assert (F : CheckerCycle.psi (Z.to_nat n) = rev f ++ [1%Z])
    by (rewrite <- (rev_involutive (CheckerCycle.psi _)), Rf; reflexivity).
  unfold relation_holds. cbn [degree rest]. rewrite minus_value, in_leaf_value, Nat2N.id.
  rewrite F, at_app, rev_length in C. simpl (Leaves.at_ [1%Z] _) in C. lra.
Qed.

Lemma new_part_ok n x more : new_part most u turn st n = Some (x, more) -> agrees (leaves st ++ more) ->
  (0 < n)%Z /\ known_ok x (Leaves.turn (Z.to_nat n)) /\ leaves_ok (fresh st) more.
Proof.
  intros E A. unfold new_part in E. destruct (find_part 0 (leaves st)); [discriminate |].
  destruct (part_relation st n) as [r |] eqn:F; [| discriminate]. apply some_pair in E as [-> ->].
  destruct (part_relation_ok n r F) as [P H]. pose proof (leaf_of_new _ _ 0 A eq_refl) as L.
  rewrite Nat.add_0_r in L. cbn [leaf_kind kind_value] in L. specialize (H L). split; [exact P |].
  assert (C : holds u (add (cosine most u (over n (add turn turn))) (cosine most u (over n (add turn turn))))
    (Leaves.turn (Z.to_nat n))).
  { unfold Leaves.turn. rewrite INR_IZR_INZ, Z2Nat.id by lia.
    replace (2 * cos (2 * PI / IZR n)) with (cos ((PI + PI) / IZR n) + cos ((PI + PI) / IZR n))
      by (replace (PI + PI) with (2 * PI) by ring; ring).
    apply add_holds; (apply cosine_holds; [exact U |]; apply over_holds; [exact P |]; now apply add_holds). }
  split; [split; cbn [within is]; [exact C |] |].
  - unfold is_quotient. rewrite reduced_by_value, variable_value, constant_value, L by exact H. split; [lra | field].
  - intros [| [| j]] f N; try discriminate. injection N as <-. rewrite Nat.add_0_r.
    split; cbn [leaf_at leaf_relation]; [now rewrite L | intros r' E; now injection E as <-].
Qed.

Lemma seen_is x g y more : seen x g = Some (y, more) -> y = x /\ more = g.
Proof. unfold seen. destruct (is x); [| discriminate]. intros E. now injection E as <- <-. Qed.

Lemma angle_ok a x c s more : known_ok x (v a) -> angle most u turn st a x = Some (c, s,
  more) -> agrees (leaves st ++ more) ->
  is_quotient l c (cos (v a)) /\ is_quotient l s (sin (v a)) /\ leaves_ok (fresh st) more.
Proof.
  intros [X Q] E A. unfold angle in E. destruct (is x) as [[p q] |] eqn:Ex; [| discriminate]. rewrite <- Ex in *.
  destruct (part_of_turn st (is x)) as [[n d] |] eqn:N.
  - injection E as <- <- <-. apply agrees_before in A. destruct (part_of_turn_ok _ _ _ _ A Q N) as [D V].
    split; [rewrite V; now apply part_cosine_ok |]. split; [| apply none_new].
    replace (sin (v a)) with (cos (2 * PI * (IZR (4 * n - d) / IZR (4 * d)))); [now apply part_cosine_ok |].
    rewrite <- (cos_shift (v a)), <- cos_neg. f_equal. rewrite V, minus_IZR, !mult_IZR. field. now apply not_0_IZR.
  - destruct (find_leaf most st true (angle_key st) (is x) 0 (leaves st)) as [[j same] |] eqn:F.
    + destruct (find_leaf_found _ _ _ _ _ _ _ F) as (f & y & _ & Nj & K & B & _). rewrite Nat.sub_0_r in Nj.
      rewrite Nj in E.
      destruct f as [kf ef rf]. cbn [leaf_kind] in K. unfold angle_key in K.
        destruct kf as [| b | | | | | |]; try discriminate.
      destruct (is_sine st (S j) b) eqn:Sb; [| discriminate]. injection E as <- <- <-.
      pose proof (key_sign y (is x) (v a) (v b) same Q (quotient_at_is b y K) B) as Eb.
      apply agrees_before in A. pose proof (A j _ Nj) as Lc. cbn [leaf_kind kind_value] in Lc.
      unfold is_sine in Sb. destruct (nth_error (leaves st) (S j)) as [[ks es rs] |] eqn:Ns; [| discriminate].
        cbn [leaf_kind] in Sb.
      destruct ks as [| | b' | | | | |]; try discriminate. apply Z.eqb_eq in Sb. subst b'.
      pose proof (A (S j) _ Ns) as Ls. cbn [leaf_kind kind_value] in Ls.
      assert (Cb : cos (v a) = l j) by (rewrite Lc, Eb; destruct same; [reflexivity | symmetry; apply cos_neg]).
      split; [rewrite Cb; apply leaf_q_is |]. split; [| apply none_new]. destruct same.
      * replace (sin (v a)) with (l (S j)) by (rewrite Ls, Eb; reflexivity). apply leaf_q_is.
      * replace (sin (v a)) with (- l (S j)) by (rewrite Ls, Eb, sin_neg; ring). apply q_neg_is, leaf_q_is.
    + injection E as <- <- <-. pose proof (leaf_of_new _ _ 0 A eq_refl) as Lc.
      pose proof (leaf_of_new _ _ 1 A eq_refl) as Ls.
      rewrite Nat.add_0_r in Lc. replace (fresh st + 1)%nat with (S (fresh st)) in Ls by lia.
        cbn [leaf_kind kind_value] in Lc, Ls.
      split; [rewrite <- Lc; apply leaf_q_is |]. split; [rewrite <- Ls; apply leaf_q_is |].
      intros [| [| [| j]]] f Nf; try discriminate; injection Nf as <-; (split; cbn [leaf_at leaf_relation];
        [| intros r Er]).
      * rewrite Nat.add_0_r, Lc. now apply cosine_holds.
      * discriminate.
      * replace (fresh st + 1)%nat with (S (fresh st)) by lia. rewrite Ls. apply sine_holds; trivial. apply pi2_holds.
      * injection Er as <-. unfold relation_holds. cbn [degree rest].
        replace (fresh st + 1)%nat with (S (fresh st)) by lia.
        rewrite plus_value, minus_value, times_value, variable_value, constant_value, Lc, Ls.
          change (N.to_nat 2) with 2%nat.
        pose proof (sin2_cos2 (v a)) as P. unfold Rsqr in P. simpl. lra.
Qed.

Lemma exp_known_ok f x r e more : known_ok x r -> (more <> [] -> kind_value f = exp r) ->
  exp_known most u st f x = Some (e, more) ->
  agrees (leaves st ++ more) -> is_quotient l e (exp r) /\ leaves_ok (fresh st) more.
Proof.
  intros [X Q] Kf E A. unfold exp_known in E. destruct (is x) as [[p q] |] eqn:Ex; [| discriminate].
    rewrite <- Ex in *.
  destruct (is_null (is x)) eqn:N.
  - injection E as <- <-. rewrite (null_is_zero l _ _ Q N), exp_0. split; [apply (q_integer_is l 1) | apply none_new].
  - destruct (find_leaf most st true (exp_key st) (is x) 0 (leaves st)) as [[j same] |] eqn:F.
    + injection E as <- <-. destruct (find_leaf_found _ _ _ _ _ _ _ F) as (g & y & _ & Nj & K & B & _).
      rewrite Nat.sub_0_r in Nj.
      apply agrees_before in A. pose proof (A j g Nj) as L. split; [| apply none_new].
      assert (G : exists s, l j = exp s /\ is_quotient l y s).
      { destruct g as [kg eg rg]. cbn [leaf_kind] in *. unfold exp_key in K.
        destruct kg as [| | | b | | | |]; try discriminate.
        - exists (v b). split; [exact L | now apply quotient_at_is].
        - exists 1. injection K as <-. split; [exact L | apply (q_integer_is l 1)]. }
      destruct G as (s & Ls & Qy). pose proof (key_sign y (is x) r s same Q Qy B) as Es. subst s. destruct same.
      * rewrite <- Ls. apply leaf_q_is.
      * replace (exp r) with (/ l j) by (rewrite Ls, exp_Ropp, Rinv_inv; reflexivity).
        apply q_inverse_is; [rewrite Ls; pose proof (exp_pos (- r)); lra | apply leaf_q_is].
    + injection E as <- <-. pose proof (leaf_of_new _ _ 0 A eq_refl) as L. rewrite Nat.add_0_r in L.
      cbn [leaf_kind] in L. rewrite Kf in L by discriminate.
      split; [rewrite <- L; apply leaf_q_is |]. intros [| [| j]] g Ng; try discriminate. injection Ng as <-.
        rewrite Nat.add_0_r.
      split; cbn [leaf_at leaf_relation]; [rewrite L; now apply exponential_holds | discriminate].
Qed.

Lemma half_is : is_quotient l (half most) (/ 2).
Proof. unfold half. replace (/ 2) with (IZR 1 / IZR 2) by (simpl; field). apply q_fraction_is. Qed.

Lemma hyperbolic_ok x r : agrees (leaves st) -> known_ok x r ->
  known_ok (fst (hyperbolic most u st x)) (sinh r) /\ known_ok (snd (hyperbolic most u st x)) (cosh r).
Proof.
  intros A K. unfold hyperbolic. cbv zeta. cbn [fst snd].
  assert (E : is_quotient l (match exp_known most u st (SineOf 0) x with Some (e, []) => e | _ => None end) (exp r)).
  { destruct (exp_known most u st (SineOf 0) x) as [[e [| g more]] |] eqn:F; try exact I.
    apply (exp_known_ok (SineOf 0) x r e []); trivial; [| now rewrite app_nil_r]. intros N. now elim N. }
  set (e := match exp_known most u st (SineOf 0) x with Some (e, []) => e | _ => None end) in *.
  pose proof (exp_pos r) as P. assert (F : is_quotient l (q_inverse e) (exp (- r))) by (rewrite exp_Ropp;
    apply q_inverse_is; [lra | exact E]).
  pose proof (exponential_holds most u _ _ U (proj1 K)) as Y.
  assert (Z : holds u (inverse u (exponential most u (within x))) (exp (- r))) by (rewrite exp_Ropp;
    now apply inverse_holds).
  unfold sinh, cosh. split; (split; cbn [within is]).
  - apply (over_holds u 2); [reflexivity |]. now apply sub_holds.
  - unfold Rdiv. rewrite Rmult_comm. apply q_mul_is; [exact R0 | apply half_is | now apply q_sub_is].
  - apply (over_holds u 2); [reflexivity |]. now apply add_holds.
  - unfold Rdiv. rewrite Rmult_comm. apply q_mul_is; [exact R0 | apply half_is | now apply q_add_is].
Qed.

Lemma cosh_not_zero r : cosh r <> 0.
Proof. unfold cosh. pose proof (exp_pos r). pose proof (exp_pos (- r)). lra. Qed.

Lemma find_half_turn_found ls : forall j i, find_half_turn j ls = Some i ->
  exists f, (j <= i)%nat /\ nth_error ls (i - j) = Some f /\ leaf_kind f = HalfTurn.
Proof.
  induction ls as [| f ls IH]; intros j i E; [discriminate |]. cbn [find_half_turn] in E.
    destruct (is_half_turn f) eqn:H.
  - injection E as <-. exists f. rewrite Nat.sub_diag. unfold is_half_turn in H.
    destruct (leaf_kind f); try discriminate. now repeat split.
  - destruct (IH _ _ E) as (g & L & N & K). exists g. replace (i - j)%nat with (S (i - S j)) by lia.
    repeat split; trivial. lia.
Qed.

(* ---- inverse functions ---- *)

Lemma up_to_one_ok x r : known_ok x r -> is_up_to_one most u st x = true -> r <= 1.
Proof.
  intros [X Q] E. unfold is_up_to_one in E. apply orb_prop in E as [E | E].
  - right. exact (equal_are l most _ R0 _ _ r 1 Q (q_integer_is l 1) E).
  - destruct (within x) as [[a b] |]; [| discriminate]. apply Z.leb_le, IZR_le in E. pose proof (IZR_lt _ _ U).
    destruct X as [_ X]. apply Rmult_le_reg_r with (IZR u); lra.
Qed.

Lemma in_domain_ok f x r : known_ok x r -> is_in_domain most u st f x = true -> inverse_defined f r.
Proof.
  intros K E.
  assert (B : is_up_to_one most u st x && is_up_to_one most u st (Known (neg (within x)) (q_neg (is x))) = true ->
    -1 <= r <= 1).
  { intros D. apply andb_prop in D as [D1 D2]. apply (up_to_one_ok x r K) in D1.
    apply (up_to_one_ok _ (- r)) in D2; [lra |]. split; [apply neg_holds, K | apply q_neg_is, K]. }
  destruct f; cbn [is_in_domain inverse_defined] in *; auto. apply Z.eqb_eq in E.
  exact (sign_positive u U _ _ (proj1 K) E).
Qed.

Lemma inverse_key_is f g y : inverse_key st f g = Some y -> exists b, g = InverseOf f b /\ quotient_at st b = Some y.
Proof.
  destruct f, g as [| | | | | | | h b]; try discriminate; destruct h; try discriminate; intros E; now exists b.
Qed.

Lemma inverse_known_ok f a x y more : known_ok x (v a) ->
  inverse_known most root_hint u turn st f a x = Some (y, more) -> agrees (leaves st ++ more) ->
  inverse_defined f (v a) /\ known_ok y (inverse_at f (v a)) /\ leaves_ok (fresh st) more.
Proof.
  intros K E A. unfold inverse_known in E. cbv zeta in E. destruct (is x) as [q |] eqn:Ex; [| discriminate].
  rewrite <- Ex in E.
  destruct (is_in_domain most u st f x) eqn:D; [| discriminate]. cbn [negb] in E. apply (in_domain_ok f x _ K) in D.
  pose proof (inverse_value_holds most root_hint u _ f _ _ U pi2_holds D (proj1 K)) as H.
  set (e := inverse_value most root_hint u (pi2 turn) f (within x)) in *. split; [exact D |].
  destruct (find_leaf most st false (inverse_key st f) (is x) 0 (leaves st)) as [[j same] |] eqn:F.
  - apply some_pair in E as [-> ->]. destruct (find_leaf_found _ _ _ _ _ _ _ F) as (g & z & _ & N & Kg & B & S).
    destruct S as [-> | S]; [| discriminate]. rewrite Nat.sub_0_r in N. apply inverse_key_is in Kg as (b & G & Z).
    apply agrees_before in A. pose proof (A j g N) as L. rewrite G in L. cbn [kind_value] in L.
    pose proof (key_sign z (is x) (v a) (v b) true (proj2 K) (quotient_at_is b z Z) B) as V. cbn in V.
    split; [split; cbn [within is]; [exact H | rewrite <- V, <- L; apply leaf_q_is] | apply none_new].
  - apply some_pair in E as [-> ->]. pose proof (leaf_of_new _ _ 0 A eq_refl) as L. rewrite Nat.add_0_r in L.
    cbn [leaf_kind kind_value] in L. split; [split; cbn [within is]; [exact H | rewrite <- L; apply leaf_q_is] |].
    intros [| [| j]] g N; try discriminate. injection N as <-. rewrite Nat.add_0_r.
    split; cbn [leaf_at leaf_relation]; [now rewrite L | discriminate].
Qed.

(* ---- lines ---- *)

Lemma up_to_ok n x r : known_ok x r -> known_ok (up_to u n x) r.
Proof. intros [X Q]. split; [| exact Q]. cbn [up_to within]. destruct (_ <? _)%Z; [exact X | exact I]. Qed.

Theorem step_ok o x more : step most root_hint zero_hint u turn st k o = Some (x, more) -> described k o ->
  agrees (leaves st ++ more) -> defined k o /\ known_ok x (v k) /\ leaves_ok (fresh st) more.
Proof.
  intros E V A. pose proof (agrees_before more A) as A0. pose proof none_new as Z0.
  destruct o; cbn [step described defined] in *; unfold unary_up_to, unary, binary, plain in E; cbv beta in E;
    repeat match type of E with context [known_at st ?a] =>
      let y := fresh "y" in let F := fresh "F" in destruct (known_at st a) as [y |] eqn:F;
        [apply known_at_ok in F | discriminate E] end.
  - destruct (value_known most u st p q) as [w |] eqn:W; [| discriminate]. injection E as <- <-.
    apply value_known_ok in W as [N W].
    rewrite V. split; [exact N | split; [exact W | exact Z0]].
  - injection E as <- <-. rewrite V. split; [exact I | split; [now apply sum_ok | exact Z0]].
  - injection E as <- <-. rewrite V. split; [exact I | split; [now apply difference_ok | exact Z0]].
  - injection E as <- <-. rewrite V. split; [exact I | split; [now apply product_ok | exact Z0]].
  - destruct (ratio_of most u st y y0) as [w |] eqn:W; [| discriminate]. injection E as <- <-.
    destruct (ratio_ok _ _ _ _ _ F F0 W). rewrite V. now split.
  - injection E as <- <-. rewrite V. split; [exact I | split; [| exact Z0]].
    split; [now apply least_holds; [| apply F | apply F0] | now apply extreme_least].
  - injection E as <- <-. rewrite V. split; [exact I | split; [| exact Z0]].
    split; [now apply greatest_holds; [| apply F | apply F0] | now apply extreme_greatest].
  - destruct ((n <? 0)%Z && (sign_of (within y) =? 0)%Z) eqn:B; [discriminate |]. injection E as <- <-.
    assert (N : v a <> 0 \/ (0 <= n)%Z).
    { apply andb_false_iff in B as [B | B]; [right; apply Z.ltb_ge in B; exact B |]. left. apply Z.eqb_neq in B.
      exact (sign_not_zero u U _ _ (proj1 F) B). }
    split; [intros L; destruct N as [N | N]; [exact N | lia] |]. rewrite V. split; [| exact Z0].
    split; [apply power_Z_holds; [exact U | apply F] | apply q_power_Z_is; [exact R0 | exact N | apply F]].
  - injection E as <- <-. rewrite V. split; [exact I | split; [| exact Z0]].
    split; [apply neg_holds, F | apply q_neg_is, F].
  - injection E as <- <-. rewrite V. split; [exact I | split; [exact F | exact Z0]].
  - injection E as <- <-. rewrite V. split; [exact I | split; [| exact Z0]].
    split; [apply absolute_holds; [exact U | apply F] | now apply absolute_ok].
  - destruct (radical_ok false y (v a) s x more F E V A) as (P & Q & R1 & S1). split; [split; auto | now split].
  - destruct (radical_ok true y (v a) s x more F E V A) as (_ & Q & R1 & S1). now split.
  - apply (up_to_ok most_angle) in F; revert F E; generalize (up_to u most_angle y); clear y; intros y F E.
    destruct (angle most u turn st a y) as [[[c s] m] |] eqn:G; [| discriminate]. apply seen_is in E as [-> ->].
    destruct (angle_ok a y c s m F G A) as (C & S1 & L). rewrite V. split; [exact I | split; [| exact L]].
    split; [apply cosine_holds; [exact U | apply F] | exact C].
  - apply (up_to_ok most_angle) in F; revert F E; generalize (up_to u most_angle y); clear y; intros y F E.
    destruct (angle most u turn st a y) as [[[c s] m] |] eqn:G; [| discriminate]. apply seen_is in E as [-> ->].
    destruct (angle_ok a y c s m F G A) as (C & S1 & L). rewrite V. split; [exact I | split; [| exact L]].
    split; [apply sine_holds; [exact U | apply pi2_holds | apply F] | exact S1].
  - apply (up_to_ok most_angle) in F; revert F E; generalize (up_to u most_angle y); clear y; intros y F E.
    destruct (angle most u turn st a y) as [[[c s] m] |] eqn:G; [| discriminate].
    destruct (ratio_of most u st _ _) as [w |] eqn:W; [| discriminate]. apply seen_is in E as [-> ->].
    destruct (angle_ok a y c s m F G A) as (C & S1 & L).
    destruct (ratio_ok (Known (sine most u (pi2 turn) (within y)) s) (Known (cosine most u (within y)) c) w (sin (v
      a)) (cos (v a))) as [N K]; trivial.
    + split; [apply sine_holds; [exact U | apply pi2_holds | apply F] | exact S1].
    + split; [apply cosine_holds; [exact U | apply F] | exact C].
    + split; [exact N |]. rewrite V. now split.
  - apply (up_to_ok most_power) in F; revert F E; generalize (up_to u most_power y); clear y; intros y F E.
    destruct (exp_known most u st (ExpOf a) y) as [[e m] |] eqn:G; [| discriminate]. injection E as <- <-.
    destruct (exp_known_ok (ExpOf a) y (v a) e m F (fun _ => eq_refl) G A) as [Q L]. rewrite V.
      split; [exact I | split; [| exact L]].
    split; [apply exponential_holds; [exact U | apply F] | exact Q].
  - apply (up_to_ok most_power) in F; revert F E; generalize (up_to u most_power y); clear y; intros y F E.
    apply seen_is in E as [-> ->]. rewrite V. split; [exact I | split; [now apply hyperbolic_ok | exact Z0]].
  - apply (up_to_ok most_power) in F; revert F E; generalize (up_to u most_power y); clear y; intros y F E.
    apply seen_is in E as [-> ->]. rewrite V. split; [exact I | split; [now apply hyperbolic_ok | exact Z0]].
  - apply (up_to_ok most_power) in F; revert F E; generalize (up_to u most_power y); clear y; intros y F E.
    destruct (ratio_of most u st _ _) as [w |] eqn:W; [| discriminate]. apply seen_is in E as [-> ->].
    destruct (hyperbolic_ok y (v a) A0 F) as [H1 H2]. destruct (ratio_ok _ _ _ _ _ H1 H2 W) as [_ K].
    rewrite V. split; [exact I | split; [exact K | exact Z0]].
  - destruct (inverse_known_ok f a y x more F E A) as (D & K & L). rewrite V. now split.
  - destruct (find_half_turn 0 (leaves st)) as [j |] eqn:G.
    + injection E as <- <-. destruct (find_half_turn_found _ _ _ G) as (f & _ & N & K). rewrite Nat.sub_0_r in N.
      rewrite V. split; [exact I | split; [| exact Z0]]. split; [exact T |].
      pose proof (A0 j f N) as L. rewrite K in L. cbn [kind_value] in L. cbn [is]. rewrite <- L. apply leaf_q_is.
    + injection E as <- <-. pose proof (leaf_of_new _ _ 0 A eq_refl) as L. rewrite Nat.add_0_r in L.
      cbn [leaf_kind kind_value] in L.
      rewrite V. split; [exact I | split].
      * split; [exact T |]. cbn [is]. rewrite <- L. apply leaf_q_is.
      * intros [| [| j]] f N; try discriminate. injection N as <-. rewrite Nat.add_0_r.
        split; cbn [leaf_at leaf_relation]; [rewrite L; exact T | discriminate].
  - destruct (exp_known most u st ExpOne _) as [[e m] |] eqn:G; [| discriminate]. injection E as <- <-.
    assert (K1 : known_ok (Known (whole u 1) (q_integer 1)) 1) by (split;
      [now apply (whole_holds u 1) | apply (q_integer_is l 1)]).
    destruct (exp_known_ok ExpOne _ 1 e m K1 (fun _ => eq_refl) G A) as [Q L]. rewrite V.
      split; [exact I | split; [| exact L]].
    split; [apply exponential_holds; [exact U | apply K1] | exact Q].
  - destruct (new_part_ok n x more E A) as (P & K & L). rewrite V. now split.
  - destruct (polynomial_root_ok r s x more E V A) as (P & Q & K & L). split; [now split | now split].
  - injection E as <- <-. pose proof (leaf_of_new _ _ 0 A eq_refl) as L. rewrite Nat.add_0_r in L.
    cbn [leaf_kind kind_value] in L.
    rewrite Rmult_1_l in L. split; [exact I | split].
    + split; [exact I |]. cbn [is]. rewrite <- L. apply leaf_q_is.
    + intros [| [| j]] f N; try discriminate. injection N as <-. split; [exact I | discriminate].
Qed.

End Step.
(* Number j of the lines, which begin with number k. *)
Definition line_at (k : Z) (ls : list line) (j : Z) (o : line) : Prop := (k <= j)%Z /\ nth_error ls (Z.to_nat (j -
  k)) = Some o.

Lemma run_leaves ls : forall st k st', run most root_hint zero_hint u turn st k ls = inl st' -> exists more,
  leaves st' = leaves st ++ more.
Proof.
  induction ls as [| o ls IH]; intros st k st' E; cbn [run] in E; [injection E as <-; exists [];
    now rewrite app_nil_r |].
  destruct (step _ _ _ _ _ st k o) as [[x more] |]; [| discriminate]. destruct (IH _ _ _ E) as [rest R].
    cbn [leaves] in R.
  exists (more ++ rest). now rewrite R, app_assoc.
Qed.

Lemma state_goes_on st k x more : state_ok st -> known_ok x (v k) -> leaves_ok (fresh st) more ->
  state_ok (State (Map.add k x (numbers st)) (leaves st ++ more)).
Proof.
  intros [N L] X M. split; cbn [numbers leaves].
  - intros a y F. destruct (Z.eq_dec k a) as [<- | D].
    + pose proof (Map.find_1 (Map.add_1 (numbers st) x (eq_refl k))) as G. assert (y = x) by congruence. now subst y.
    + apply N. apply Map.find_1. exact (Map.add_3 D (Map.find_2 F)).
  - intros j f F. destruct (Nat.lt_ge_cases j (length (leaves st))) as [B | B].
    + rewrite nth_error_app1 in F by exact B. exact (L j f F).
    + rewrite nth_error_app2 in F by exact B. specialize (M _ f F). unfold fresh in M. simpl.
      now replace (length (leaves st) + (j - length (leaves st)))%nat with j in M by lia.
Qed.

(* Every number of a block that is taken is defined, in its interval, and its quotient. *)
Theorem run_ok ls : forall st k st', run most root_hint zero_hint u turn st k ls = inl st' -> state_ok st ->
  agrees (leaves st') ->
  (forall j o, line_at k ls j o -> described j o) -> state_ok st' /\ forall j o, line_at k ls j o -> defined j o.
Proof.
  induction ls as [| o ls IH]; intros st k st' E S A D; cbn [run] in E.
  - injection E as <-. split; [exact S |]. intros j o [_ N]. destruct (Z.to_nat (j - k)); discriminate.
  - destruct (step _ _ _ _ _ st k o) as [[x more] |] eqn:X; [| discriminate].
    destruct (run_leaves _ _ _ _ E) as [rest R]. cbn [leaves] in R.
    assert (A' : agrees (leaves st ++ more)).
    { intros j f F. apply A. rewrite R, nth_error_app1; [exact F |]. apply nth_error_Some. congruence. }
    assert (Dk : described k o) by (apply D; split; [lia | now rewrite Z.sub_diag]).
    destruct (step_ok st S k o x more X Dk A') as (Q & K & L).
    destruct (IH _ _ _ E (state_goes_on st k x more S K L) A) as [S' D'].
    { intros j p [J N]. apply D. split; [lia |].
      replace (Z.to_nat (j - k)) with (Datatypes.S (Z.to_nat (j - (k + 1)))) by lia. exact N. }
    split; [exact S' |]. intros j p [J N]. destruct (Z.eq_dec j k) as [-> | Njk].
    + rewrite Z.sub_diag in N. injection N as <-. exact Q.
    + apply D'. split; [lia |]. replace (Z.to_nat (j - k)) with (Datatypes.S (Z.to_nat (j - (k + 1)))) in N by lia.
      exact N.
Qed.

End Sound.
End Meaning.
